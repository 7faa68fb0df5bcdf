/// \file
/// \internal
/// Conjugate gradients with the multigrid preconditioner, every loop parallel with the same bits
/// for any thread count.
///
/// The flexible form (Polak and Ribiere's beta) forgives the rounding of a single precision
/// preconditioner. The residual that the recurrence carries drifts from b - Ax: once it is small
/// enough the true one is computed, and where that is not, iterations go on from there.
#pragma once

#include "libdsc/solve/sparse_rows.h"

namespace dsc {

class MultigridHierarchy;

struct ConjugateGradientResult {
  int iterations = 0;
  double relative_residual = 0.0;  ///< true, at the end
};

/// Improves x until |b - Ax| <= tolerance |b|. b must lie in the range of A where A is singular.
/// For b = 0, x becomes 0.
/// \throws SolverError where A or the preconditioner proves indefinite or the tolerance is not
///         reached in max_iterations; Cancelled.
ConjugateGradientResult conjugate_gradient(RowsView<double> a, const MultigridHierarchy& multigrid,
                                           const Eigen::VectorXd& b, Eigen::VectorXd& x,
                                           double tolerance, int max_iterations,
                                           const Context& context);

/// |b - Ax| / |b|, 0 where b - Ax is 0.
double relative_residual(RowsView<double> a, const Eigen::VectorXd& b, const Eigen::VectorXd& x,
                         const Context& context);

/// Euclidean norm; no overflow or underflow for finite v.
double norm(const Eigen::VectorXd& v, const Context& context);

[[noreturn]] void throw_not_converged(int iterations, double reached, double asked);

}  // namespace dsc
