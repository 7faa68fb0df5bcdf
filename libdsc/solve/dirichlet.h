/// \file
/// A x = b with x given on some vertices (Dirichlet) or determined up to a constant (Neumann).
///
/// Both reduce to the free unknowns f: A_ff x_f = b_f - A_fg x_g, which is symmetric positive
/// definite when A is positive semi-definite and its kernel, the constants of each connected
/// component, is cut by the fixed vertices.
#pragma once

#include "libdsc/solve/components.h"
#include "libdsc/solve/multigrid.h"
#include "libdsc/solve/spd_solver.h"

#include <optional>
#include <span>
#include <vector>

namespace dsc {

/// Built once for a matrix and a set of fixed vertices, then solved for many b and values.
class DirichletSolver {
 public:
  /// `A` is n x n, symmetric positive semi-definite (-L, or M0 - t L); `fixed` are its fixed
  /// unknowns, in any order, duplicates allowed. \throws UsageError where a fixed vertex is not in
  /// [0, n); SolverError where a component of A with a kernel has no fixed vertex.
  DirichletSolver(const SparseMatrix& A, std::span<const VertexId> fixed,
                  const SolverOptions& options = {}, const Context& context = {},
                  const SpdSolverFactory& factory = {});

  /// `b` and `values` have n entries; x equals `values` at the fixed vertices, exactly, and A x = b
  /// at all others. `values` at free vertices is the first guess of iterative methods. The residual
  /// is that of the reduced system. \throws as SpdSolver::solve does.
  Solution solve(const Eigen::VectorXd& b, const Eigen::VectorXd& values,
                 const Context& context = {}) const;

  /// n less the fixed ones.
  Index free_unknowns() const { return static_cast<Index>(free_.size()); }

 private:
  Index n_;
  std::vector<VertexId> free_;
  SparseMatrix coupling_;              ///< A restricted to free rows; free columns are empty
  std::unique_ptr<SpdSolver> solver_;  ///< null where nothing is free
};

/// A x = b for an A whose kernel is the constants of each component (-L): one vertex of each is
/// fixed, and x is shifted to mean zero there. No multiple of the identity is added to A. The
/// components may be the classes of checkerboard.h, whose couplings cross: solved directly then.
class NeumannSolver {
 public:
  /// `A` is n x n, symmetric positive semi-definite; `components` have n vertices. \throws
  /// UsageError where they have another number, and as DirichletSolver or MultigridSolver does.
  NeumannSolver(SparseMatrix A, Components components, const SolverOptions& options = {},
                const Context& context = {}, const SpdSolverFactory& factory = {});

  /// `b` has n entries whose sum vanishes on each component, up to 1e-9 of the sum of |b| there.
  /// `weights` (empty: all 1; else n positive ones, such as M0) define the mean that is made zero.
  /// `guess` (empty or n entries) is the first guess of iterative methods.
  /// \throws InputError where a component's b does not sum to zero: no solution exists.
  Solution solve(const Eigen::VectorXd& b, const Eigen::VectorXd& weights = {},
                 const Eigen::VectorXd& guess = {}, const Context& context = {}) const;

 private:
  Components components_;
  double tolerance_;
  std::optional<DirichletSolver> direct_;
  std::optional<MultigridSolver> multigrid_;  ///< takes the singular matrix as it is
};

}  // namespace dsc
