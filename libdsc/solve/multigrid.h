/// \file
/// Conjugate gradients preconditioned by smoothed-aggregation algebraic multigrid, for the large
/// sparse symmetric positive (semi-)definite systems of this library: -L, the negated weak
/// Laplacian of a surface, and -L + diagonal.
///
/// The hierarchy: strongly coupled unknowns are gathered into aggregates of a vertex and its
/// neighbours; piecewise constants on them, smoothed once, span the next coarser space (P); its
/// matrix is P^T A P; and so on until a direct solver takes over. One V-cycle with Chebyshev
/// smoothing, in single precision, is the preconditioner; the conjugate gradients around it are in
/// double precision, so precision of the answer is that of double.
/// Source: P. Vanek, J. Mandel, M. Brezina, Algebraic multigrid by smoothed aggregation for second
/// and fourth order elliptic problems, Computing 56, 1996.
///
/// Guaranteed: a solution returned has the asked relative residual, recomputed from A and x; the
/// same bits for any thread count. Time and memory grow linearly with the unknowns.
/// Degenerate input: a matrix with no rows gives an empty solution; a zero right-hand side gives
/// zero; an isolated vertex with an empty row is a singular component of one unknown.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/base/types.h"

#include <memory>

namespace dsc {

/// Tuning parameters; the defaults suit Laplacians of digital surfaces, naive and projected.
struct MultigridOptions {
  /// A coupling a_ij < 0 is strong where |a_ij| >= strength * min(m_i, m_j), m_i the largest
  /// |a_ik| among the negative couplings of row i. In [0, 1].
  double strength = 0.25;
  /// Weight of the neighbours in the smoothed prolongation, in [0, 1): 0 leaves it piecewise
  /// constant.
  double prolongation_weight = 2.0 / 3.0;
  /// Degree of the Chebyshev polynomial before and after the coarse correction, at least 1.
  int smoothing_degree = 2;
  /// The smoother damps the eigenvalues in [lambda_max / smoothing_range, lambda_max]; above 1.
  double smoothing_range = 10.0;
  /// Levels with at most this many unknowns are solved directly; at least 1.
  Index coarse_size = 1000;
  /// Conjugate gradient iterations before giving up; at least 1.
  int max_iterations = 500;
  /// Largest part of the right-hand side, relative to its norm, that may lie outside the range of
  /// a singular matrix. Only rounding belongs there.
  double max_incompatibility = 1e-6;
};

/// What the set-up built.
struct MultigridReport {
  int levels = 0;                    ///< including the finest
  Index singular_components = 0;     ///< components whose rows all sum to zero
  double operator_complexity = 0.0;  ///< nonzeros of all levels / nonzeros of A
  Index bytes = 0;                   ///< held by the solver between solves, its copy of A included
};

/// Owns a copy of the matrix and the hierarchy built from it; solves are const and may run side by
/// side.
class MultigridSolver {
 public:
  /// What a solve returns.
  struct Solution {
    Eigen::VectorXd x;   ///< n values
    int iterations = 0;  ///< of conjugate gradients
    /// |b - Ax| / |b|, recomputed, with b as projected onto the range of A; 0 for b = 0.
    double relative_residual = 0.0;
    /// |removed part of b| / |b|: what the projection onto the range of a singular A took away.
    double incompatibility = 0.0;
  };

  /// \param matrix symmetric, both triangles stored, n x n (pass an rvalue to spare the copy).
  /// \throws UsageError for options out of range, a matrix that is not square or not symmetric;
  ///         SolverError for entries that are not finite and for evident indefiniteness (a
  ///         negative diagonal entry; a connected component with a negative sum of entries).
  explicit MultigridSolver(SparseMatrix matrix, const MultigridOptions& options = {},
                           const Context& context = {});
  /// The same without a copy: for a compressed matrix that the caller shares.
  explicit MultigridSolver(std::shared_ptr<const SparseMatrix> matrix,
                           const MultigridOptions& options = {}, const Context& context = {});
  ~MultigridSolver();
  MultigridSolver(MultigridSolver&&) noexcept;
  MultigridSolver& operator=(MultigridSolver&&) noexcept;

  /// Solves A x = b to |b - Ax| <= relative_tolerance * |b|.
  ///
  /// The connected components of the matrix's graph whose rows all sum to zero are singular: there
  /// b is made to sum to zero (the part removed is reported), and x gets the mean of `start` over
  /// the component, zero without a start. "Mean" is over the unknowns, unweighted.
  /// \param b n values; \param start n values to begin from, or null for zero.
  /// \throws UsageError for a wrong size or a tolerance outside (0, 1); SolverError for values that
  ///         are not finite, an incompatible b, an indefinite matrix, or a tolerance not reached;
  ///         Cancelled between two iterations.
  Solution solve(const Eigen::VectorXd& b, const Eigen::VectorXd* start, double relative_tolerance,
                 const Context& context = {}) const;

  /// Of the set-up.
  const MultigridReport& report() const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

}  // namespace dsc
