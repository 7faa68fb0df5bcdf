#include "libdsc/algorithms/diffusion.h"

#include "libdsc/base/error.h"
#include "libdsc/calculus/assembly.h"

#include <cmath>
#include <string>

namespace dsc {

SparseMatrix heat_matrix(const LaplaceSystem& system, double t) {
  if (!(t > 0 && std::isfinite(t))) {
    throw UsageError("heat: the time step " + std::to_string(t) + " is not positive and finite");
  }
  // The pattern of L holds its whole diagonal, but for vertices without faces.
  SparseMatrix diagonal(system.L.rows(), system.L.cols());
  diagonal.setIdentity();
  for (Index v = 0; v < system.L.rows(); ++v) {
    if (system.mass[v] != 0) diagonal.valuePtr()[v] = system.mass[v];
  }
  return diagonal - t * system.L;
}

HeatDiffusion::HeatDiffusion(const FlatMesh& mesh, double t, const DiffusionOptions& options,
                             const Context& context)
    : time_(t) {
  LaplaceSystem system = assemble_laplacian(mesh, options.calculus, context);
  clamped_faces_ = system.clamped_faces;
  SparseMatrix A = heat_matrix(system, t);
  weight_ = system.mass;
  for (double& w : weight_) {
    if (w == 0) w = 1;
  }
  mass_ = std::move(system.mass);
  system.L.resize(0, 0);
  solver_ = make_solver(options.factory, std::move(A), options.solver, context);
}

Solution HeatDiffusion::step(const Eigen::VectorXd& u0) const {
  if (u0.size() != mass_.size()) {
    throw UsageError("diffusion: the function has " + std::to_string(u0.size()) + " values for " +
                     std::to_string(mass_.size()) + " vertices");
  }
  return solver_->solve(weight_.cwiseProduct(u0), u0);
}

Solution diffuse(const FlatMesh& mesh, const Eigen::VectorXd& u0, double t,
                 const DiffusionOptions& options, const Context& context) {
  return HeatDiffusion(mesh, t, options, context).step(u0);
}

}  // namespace dsc
