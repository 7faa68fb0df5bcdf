#include "libdsc/algorithms/diffusion.h"

#include "libdsc/base/error.h"
#include "libdsc/base/parallel.h"
#include "libdsc/calculus/assembly.h"
#include "libdsc/solve/checkerboard.h"
#include "libdsc/solve/matrix_memory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace dsc {

SparseMatrix heat_matrix(const LaplaceSystem& system, double t, const Context& context) {
  if (!(t > 0 && std::isfinite(t))) {
    throw UsageError("heat: the time step " + std::to_string(t) + " is not positive and finite");
  }
  if ((system.mass.array() == 0).any()) {  // columns without a diagonal entry
    context.need("heat matrix", 3 * matrix_bytes(system.L));
    SparseMatrix diagonal(system.L.rows(), system.L.cols());
    diagonal.setIdentity();
    for (Index v = 0; v < system.L.rows(); ++v) {
      if (system.mass[v] != 0) diagonal.valuePtr()[v] = system.mass[v];
    }
    return diagonal - t * system.L;
  }
  context.need("heat matrix", matrix_bytes(system.L));
  SparseMatrix A = system.L;  // the pattern is that of L: the values alone differ
  parallel_for(context, A.cols(), 4096, [&](Index first, Index last) {
    for (Index v = first; v < last; ++v) {
      for (SparseMatrix::InnerIterator it(A, v); it; ++it) {
        it.valueRef() = (it.row() == v ? system.mass[v] : 0.) - t * it.value();
      }
    }
  });
  return take(A);
}

namespace {

/// The rounding of t L u relative to M0 u, for a constant u.
double rounding_of(const LaplaceSystem& system, double t) {
  double largest = 0;
  for (Index v = 0; v < system.L.rows(); ++v) {
    if (system.mass[v] > 0) largest = std::max(largest, -system.L.coeff(v, v) / system.mass[v]);
  }
  return t * largest * std::numeric_limits<double>::epsilon();
}

}  // namespace

HeatDiffusion::HeatDiffusion(const FlatMesh& mesh, double t, const DiffusionOptions& options,
                             const Context& context)
    : time_(t) {
  LaplaceSystem system = assemble_laplacian(mesh, options.calculus, context);
  clamped_faces_ = system.clamped_faces;
  SparseMatrix A = heat_matrix(system, t, context);
  const double rounding = rounding_of(system, t);
  if (static_cast<double>(system.L.rows() + 10) * rounding > 1) {
    throw UsageError("diffusion: after the time " + std::to_string(t) +
                     " heat is even to the last digit; choose a shorter one");
  }
  if (rounding > options.solver.tolerance) {
    components_ = kernel_classes(mesh, options.calculus.stabilization);
  }
  weight_ = system.mass;
  for (double& w : weight_) {
    if (w == 0) w = 1;
  }
  mass_ = std::move(system.mass);
  system.L.resize(0, 0);
  solver_ = make_solver(options.factory, take(A), options.solver, context);
}

Solution HeatDiffusion::step(const Eigen::VectorXd& u0, const Context& context) const {
  if (u0.size() != mass_.size()) {
    throw UsageError("diffusion: the function has " + std::to_string(u0.size()) + " values for " +
                     std::to_string(mass_.size()) + " vertices");
  }
  if (components_.count() == 0) return solver_->solve(weight_.cwiseProduct(u0), u0, context);
  // The means stay as they are, and what varies around them is solved for alone: t L times a large
  // constant would be rounding only.
  const Eigen::VectorXd means = component_means(components_, weight_, u0);
  Eigen::VectorXd mean(u0.size());
  for (Index v = 0; v < u0.size(); ++v) {
    mean[v] = means[components_.of_vertex[static_cast<std::size_t>(v)]];
  }
  Solution s = solver_->solve(weight_.cwiseProduct(u0 - mean), context);
  s.x += mean;
  return s;
}

Solution diffuse(const FlatMesh& mesh, const Eigen::VectorXd& u0, double t,
                 const DiffusionOptions& options, const Context& context) {
  return HeatDiffusion(mesh, t, options, context).step(u0, context);
}

}  // namespace dsc
