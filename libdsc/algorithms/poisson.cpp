#include "libdsc/algorithms/poisson.h"

#include "libdsc/calculus/assembly.h"

#include <utility>

namespace dsc {

PoissonProblem::PoissonProblem(const FlatMesh& mesh, std::span<const VertexId> fixed,
                               const PoissonOptions& options, const Context& context) {
  LaplaceSystem system = assemble_laplacian(mesh, options.calculus, context);
  clamped_faces_ = system.clamped_faces;
  mass_ = std::move(system.mass);
  weight_ = mass_;
  for (double& w : weight_) {
    if (w == 0) w = 1;
  }
  const SparseMatrix A = -system.L;
  system.L.resize(0, 0);
  if (fixed.empty()) {
    neumann_.emplace(A, connected_components(mesh), options.solver, context, options.factory);
  } else {
    dirichlet_.emplace(A, fixed, options.solver, context, options.factory);
  }
}

Solution PoissonProblem::solve(const Eigen::VectorXd& b, const Eigen::VectorXd& values) const {
  if (neumann_) return neumann_->solve(-b, weight_);
  return dirichlet_->solve(-b, values);
}

Solution solve_poisson(const FlatMesh& mesh, const Eigen::VectorXd& b,
                       std::span<const VertexId> fixed, const Eigen::VectorXd& values,
                       const PoissonOptions& options, const Context& context) {
  return PoissonProblem(mesh, fixed, options, context).solve(b, values);
}

}  // namespace dsc
