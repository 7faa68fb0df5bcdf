#include "libdsc/algorithms/laplace_beltrami.h"

#include "libdsc/algorithms/diffusion.h"
#include "libdsc/base/error.h"

#include <chrono>
#include <cmath>
#include <string>

namespace dsc {
namespace {

LaplaceSystem assembled(const FlatMesh& mesh, const LaplaceBeltramiOptions& options,
                        const Context& context) {
  if (!(options.time >= 0 && std::isfinite(options.time))) {
    throw UsageError("laplacian: the time " + std::to_string(options.time) +
                     " is negative or not finite");
  }
  return assemble_laplacian(mesh, options.calculus, context);
}

}  // namespace

LaplaceBeltrami::LaplaceBeltrami(const FlatMesh& mesh, const LaplaceBeltramiOptions& options,
                                 const Context& context)
    : system_(assembled(mesh, options, context))  // in place: an assignment would copy the matrix
{
  weight_ = system_.mass;
  for (double& w : weight_) {
    if (w == 0) w = 1;
  }
  if (options.time > 0) {
    const auto start = std::chrono::steady_clock::now();
    solver_ = make_solver(options.factory, heat_matrix(system_, options.time, context),
                          options.solver, context);
    seconds_factorize_ =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
}

Eigen::VectorXd LaplaceBeltrami::pointwise(const Eigen::VectorXd& f) const {
  if (f.size() != weight_.size()) {
    throw UsageError("laplacian: the function has " + std::to_string(f.size()) + " values for " +
                     std::to_string(weight_.size()) + " vertices");
  }
  if (!f.allFinite()) throw InputError("laplacian: the function is not finite at every vertex");
  return (system_.L * f).cwiseQuotient(weight_);
}

Solution LaplaceBeltrami::smoothed(const Eigen::VectorXd& g, const Context& context) const {
  if (!solver_) {
    Solution same;
    same.x = g;
    return same;
  }
  return solver_->solve(weight_.cwiseProduct(g), g, context);
}

}  // namespace dsc
