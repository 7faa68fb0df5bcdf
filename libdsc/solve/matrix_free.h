/// \file
/// A x = b, A symmetric positive definite and known by its products alone: preconditioned conjugate
/// gradients for systems whose matrix would not fit, or whose products are cheaper than its
/// entries.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/base/types.h"

#include <functional>

namespace dsc {

/// Writes a product of the first vector into the second, which has its size already.
using LinearMap = std::function<void(const Eigen::VectorXd&, Eigen::VectorXd&)>;

/// The residual must be given.
struct MatrixFreeOptions {
  /// The norm ||b - A x|| to reach; positive.
  double residual = 0;
  Index max_iterations = 10000;  ///< before giving up
};

/// What solve_matrix_free() returns.
struct MatrixFreeSolution {
  Eigen::VectorXd x;     ///< of the size of b
  Index iterations = 0;  ///< steps of conjugate gradients
  double residual = 0;   ///< ||b - A x||, recomputed from x
};

/// From the first guess `x`. `apply` is A; `precondition` a symmetric positive definite
/// approximation of its inverse. The same bits for any thread count where they have them.
/// \throws UsageError where the residual asked for is not positive or the sizes differ; SolverError
/// where b or the guess is not finite, A or the preconditioner proves indefinite, or the residual
/// is not reached; Cancelled between two iterations.
MatrixFreeSolution solve_matrix_free(const LinearMap& apply, const LinearMap& precondition,
                                     const Eigen::VectorXd& b, Eigen::VectorXd x,
                                     const MatrixFreeOptions& options, const Context& context = {});

}  // namespace dsc
