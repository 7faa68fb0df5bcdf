/// \file
/// Symmetric positive definite systems A x = b, behind one interface, each solve checked.
///
/// A solver is built ready for use: it owns its copy of A and its factorization or hierarchy, so
/// nothing can go stale, and solves are const and may run from several threads at once, each under
/// a context of its own. Every solve computes its true relative residual ||b - A x|| / ||b|| with
/// the matrix as given (both triangles), corrects x once where it is above the tolerance, and
/// throws where it still is. A matrix that is singular, indefinite or not finite never gives an
/// answer.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/base/types.h"
#include "libdsc/solve/wide_vector.h"

#include <functional>
#include <memory>

namespace dsc {

/// What a solve returns.
struct Solution {
  Eigen::VectorXd x;             ///< n values
  double relative_residual = 0;  ///< ||b - A x|| / ||b||, computed from x; 0 where b = 0
  Index iterations = 0;          ///< direct solvers: the number of corrections (0 or 1)
};

/// Which of the library's solvers.
enum class SolverMethod {
  automatic,  ///< ldlt up to direct_limit unknowns, then multigrid, and ldlt where that stalls
  ldlt,       ///< sparse L D Lᵀ with a nested dissection order: exact, reusable
  multigrid,  ///< conjugate gradients preconditioned by multigrid: linear memory
};

/// From here on a direct factorization of a surface's Laplacian costs more than iterating, however
/// often it serves.
inline constexpr Index kDirectLimit = 150000;
/// The same where it serves once.
inline constexpr Index kDirectLimitOnce = 15000;

/// How systems are solved, and how well.
struct SolverOptions {
  SolverMethod method = SolverMethod::ldlt;  ///< see SolverMethod
  /// The relative residual that every solve must reach; in (0, 1).
  double tolerance = 1e-9;
  /// Of `automatic`: unknowns.
  Index direct_limit = kDirectLimit;
};

/// A system ready to be solved. A solver of your own derives from it and writes correct().
class SpdSolver {
 public:
  virtual ~SpdSolver() = default;
  SpdSolver(const SpdSolver&) = delete;
  SpdSolver& operator=(const SpdSolver&) = delete;

  /// n.
  Index size() const { return matrix_->rows(); }
  /// A as given, compressed.
  const SparseMatrix& matrix() const { return *matrix_; }

  /// x with A x = b. `b` has size() entries.
  /// \throws UsageError on another length, SolverError where b is not finite or the residual stays
  /// above the tolerance; Cancelled.
  Solution solve(const Eigen::VectorXd& b, const Context& context = {}) const;
  /// The same from a first guess: iterative methods only solve for what it leaves.
  Solution solve(const Eigen::VectorXd& b, const Eigen::VectorXd& guess,
                 const Context& context = {}) const;

  /// A x = b where x spans more than double's range, for heat far from its source. The residual of
  /// the largest entries says nothing about the others, so it is the caller who checks. This
  /// default solves in doubles and gives 0 where that loses the value; the LDLT solver's own does
  /// not.
  virtual WideVector solve_wide(const WideVector& b, const Context& context = {}) const;

 protected:
  /// \throws UsageError unless `A` is square and the tolerance in (0, 1); SolverError where an
  /// entry is not finite.
  /// What `A` holds is taken, not copied.
  SpdSolver(SparseMatrix&& A, const SolverOptions& options);

  /// A correction c with A c = r, to this relative residual at least. Direct solvers ignore it.
  struct Correction {
    Eigen::VectorXd c;     ///< n values
    Index iterations = 0;  ///< 0 for direct methods
  };
  /// Called from several threads at once. `r` is finite. \throws SolverError where it cannot.
  virtual Correction correct(const Eigen::VectorXd& r, double relative_tolerance,
                             const Context& context) const = 0;
  /// For a method that needs the matrix as long as it lives.
  const std::shared_ptr<const SparseMatrix>& shared_matrix() const { return matrix_; }

 private:
  Solution finish(const Eigen::VectorXd& b, Eigen::VectorXd x, const Context& context) const;

  std::shared_ptr<const SparseMatrix> matrix_;
  double tolerance_;
};

/// The method that `options` stand for on n unknowns: automatic resolved.
constexpr SolverMethod resolve(const SolverOptions& options, Index n) {
  if (options.method != SolverMethod::automatic) return options.method;
  return n <= options.direct_limit ? SolverMethod::ldlt : SolverMethod::multigrid;
}

/// A solver of the method asked for. `A` is n x n, symmetric positive definite, both triangles
/// stored. \throws UsageError where A is not square, SolverError where A is singular, indefinite or
/// not finite, LimitError where the factor does not fit 32-bit indices or memory.
std::unique_ptr<SpdSolver> make_spd_solver(SparseMatrix A, const SolverOptions& options = {},
                                           const Context& context = {});

/// What algorithms take where they need a solver: make_spd_solver, or make_cholmod_solver of the
/// target dsc::cholmod, or the caller's own; one that takes `SparseMatrix&&` is handed no copy.
using SpdSolverFactory = std::function<std::unique_ptr<SpdSolver>(
    SparseMatrix A, const SolverOptions& options, const Context& context)>;

/// `factory`'s solver, make_spd_solver's where it is empty.
std::unique_ptr<SpdSolver> make_solver(const SpdSolverFactory& factory, SparseMatrix A,
                                       const SolverOptions& options, const Context& context);

}  // namespace dsc
