#include "libdsc/algorithms/poisson.h"

#include "libdsc/base/error.h"
#include "libdsc/calculus/assembly.h"
#include "libdsc/solve/matrix_memory.h"

#include <string>
#include <utility>
#include <vector>

namespace dsc {
namespace {

void check_fixed(const Components& classes, std::span<const VertexId> fixed) {
  std::vector<char> held(static_cast<std::size_t>(classes.count()), 0);
  for (const VertexId v : fixed) {
    if (v < 0 || static_cast<std::size_t>(v) >= classes.of_vertex.size()) continue;  // told later
    held[static_cast<std::size_t>(classes.of_vertex[static_cast<std::size_t>(v)])] = 1;
  }
  for (std::size_t c = 0; c < held.size(); ++c) {
    if (held[c] != 0) continue;
    throw SolverError("poisson: the component (with Stabilization::mercat, the parity) of vertex " +
                      std::to_string(classes.lowest[c]) +
                      " has no fixed vertex, so that its solution is free; fix one there");
  }
}

}  // namespace

PoissonProblem::PoissonProblem(const FlatMesh& mesh, std::span<const VertexId> fixed,
                               const PoissonOptions& options, const Context& context) {
  LaplaceSystem system = assemble_laplacian(mesh, options.calculus, context);
  clamped_faces_ = system.clamped_faces;
  mass_ = std::move(system.mass);
  weight_ = mass_;
  for (double& w : weight_) {
    if (w == 0) w = 1;
  }
  context.need("assemble", 2 * matrix_bytes(system.L));
  SparseMatrix A = -system.L;
  system.L.resize(0, 0);
  Components classes = kernel_classes(mesh, options.calculus.stabilization);
  if (fixed.empty()) {
    neumann_.emplace(take(A), std::move(classes), options.solver, context, options.factory);
    if (options.calculus.stabilization == Stabilization::mercat) {
      filter_.emplace(mesh, options.calculus, context);
    }
  } else {
    check_fixed(classes, fixed);
    dirichlet_.emplace(A, fixed, options.solver, context, options.factory);
  }
}

Solution PoissonProblem::solve(const Eigen::VectorXd& b, const Eigen::VectorXd& values,
                               const Context& context) const {
  if (neumann_) {
    Solution s = neumann_->solve(-b, weight_, {}, context);
    if (filter_) filter_->remove(s.x, weight_);
    return s;
  }
  return dirichlet_->solve(-b, values, context);
}

Solution solve_poisson(const FlatMesh& mesh, const Eigen::VectorXd& b,
                       std::span<const VertexId> fixed, const Eigen::VectorXd& values,
                       const PoissonOptions& options, const Context& context) {
  return PoissonProblem(mesh, fixed, options, context).solve(b, values, context);
}

}  // namespace dsc
