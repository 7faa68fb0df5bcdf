#include "libdsc/solve/spd_solver.h"

#include "libdsc/base/error.h"
#include "libdsc/solve/ldlt_factor.h"
#include "libdsc/solve/ldlt_solver.h"
#include "libdsc/solve/matrix_memory.h"
#include "libdsc/solve/multigrid.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

namespace dsc {
namespace {

void check_length(Index length, Index n, const char* what) {
  if (length != n) {
    throw UsageError("solve: the " + std::string(what) + " has " + std::to_string(length) +
                     " entries, the matrix " + std::to_string(n) + " rows");
  }
}

/// Multigrid, and where the choice was ours, LDLT for the systems on which it stalls: meshes with
/// degenerate faces.
class MultigridSpd final : public SpdSolver {
 public:
  MultigridSpd(SparseMatrix&& A, const SolverOptions& options, const Context& context)
      : SpdSolver(std::move(A), options),
        multigrid_(shared_matrix(), MultigridOptions{}, context),
        automatic_(options.method == SolverMethod::automatic) {
    if (multigrid_.report().singular_components > 0) {
      throw SolverError("multigrid: the matrix of " + std::to_string(size()) +
                        " unknowns is singular; a Laplacian needs a fixed vertex in each connected "
                        "component");
    }
  }

 protected:
  Correction correct(const Eigen::VectorXd& r, double relative_tolerance,
                     const Context& context) const override {
    try {
      MultigridSolver::Solution s = multigrid_.solve(r, nullptr, relative_tolerance, context);
      return {std::move(s.x), s.iterations};
    } catch (const SolverError&) {
      if (!automatic_) throw;
    }
    const std::lock_guard lock(mutex_);
    if (!factor_) factor_.emplace(matrix(), FillOrder::nested_dissection, context);
    return {factor_->solve(r), 0};
  }

 private:
  MultigridSolver multigrid_;
  bool automatic_;
  mutable std::mutex mutex_;
  mutable std::optional<LdltFactor> factor_;
};

}  // namespace

SpdSolver::SpdSolver(SparseMatrix&& A, const SolverOptions& options)
    : tolerance_(options.tolerance) {
  A.makeCompressed();
  matrix_ = share(A);
  if (matrix_->rows() != matrix_->cols()) {
    throw UsageError("solver: the matrix is " + std::to_string(matrix_->rows()) + " x " +
                     std::to_string(matrix_->cols()) + ", it must be square");
  }
  if (!(tolerance_ > 0 && tolerance_ < 1)) {
    throw UsageError("solver: the tolerance must lie in (0, 1)");
  }
  if (!Eigen::Map<const Eigen::ArrayXd>(matrix_->valuePtr(), matrix_->nonZeros()).allFinite()) {
    throw SolverError("solver: the matrix has entries that are not finite");
  }
}

Solution SpdSolver::solve(const Eigen::VectorXd& b, const Context& context) const {
  check_length(b.size(), size(), "right-hand side");
  return finish(b, Eigen::VectorXd::Zero(size()), context);
}

Solution SpdSolver::solve(const Eigen::VectorXd& b, const Eigen::VectorXd& guess,
                          const Context& context) const {
  check_length(b.size(), size(), "right-hand side");
  check_length(guess.size(), size(), "first guess");
  if (!guess.allFinite()) throw SolverError("solve: the first guess is not finite");
  return finish(b, guess, context);
}

Solution SpdSolver::finish(const Eigen::VectorXd& b, Eigen::VectorXd x,
                           const Context& context) const {
  if (!b.allFinite()) throw SolverError("solve: the right-hand side is not finite");
  Solution s;
  const double scale = b.stableNorm();
  if (scale == 0) {  // x = 0 exactly, whatever the guess
    s.x = Eigen::VectorXd::Zero(size());
    return s;
  }
  Eigen::VectorXd r = b;
  if (!x.isZero(0)) r.noalias() -= *matrix_ * x;
  double residual = r.stableNorm() / scale;
  if (!(residual < 1)) {  // a guess that is worse than none
    x.setZero();
    r = b;
    residual = 1;
  }
  // One solve, one correction where it is asked for. The negated test lets NaN through to the
  // error.
  for (int pass = 0; pass < 2 && !(residual <= tolerance_ && (pass > 0 || residual == 0)); ++pass) {
    const Correction correction =
        correct(r, std::min(0.5, tolerance_ / std::max(residual, 1e-300)), context);
    s.iterations += correction.iterations + (pass > 0 && correction.iterations == 0 ? 1 : 0);
    x += correction.c;
    r = b;
    r.noalias() -= *matrix_ * x;
    residual = r.stableNorm() / scale;
  }
  if (!(residual <= tolerance_)) {
    std::ostringstream message;
    message << "solve: the relative residual is " << residual << ", above the tolerance "
            << tolerance_ << "; the matrix is not symmetric positive definite or is close to "
            << "singular, or the tolerance is too small";
    throw SolverError(message.str());
  }
  s.x = std::move(x);
  s.relative_residual = residual;
  return s;
}

WideVector SpdSolver::solve_wide(const WideVector& b, const Context& context) const {
  check_length(b.size(), size(), "right-hand side");
  bool any = false;
  std::int32_t top = 0;
  for (Index i = 0; i < size(); ++i) {
    if (b.mantissa(i) == 0) continue;
    top = any ? std::max(top, b.exponent(i)) : b.exponent(i);
    any = true;
  }
  Eigen::VectorXd scaled(size());
  for (Index i = 0; i < size(); ++i) scaled[i] = b.relative_to(i, top);
  const Eigen::VectorXd x = solve(scaled, context).x;
  WideVector result(size());
  for (Index i = 0; i < size(); ++i) {
    Wide w{std::abs(x[i]) < 1e-290 ? 0. : x[i], top};  // below, digits are missing
    w.normalise();
    result.set(i, w);
  }
  return result;
}

std::unique_ptr<SpdSolver> make_spd_solver(SparseMatrix A, const SolverOptions& options,
                                           const Context& context) {
  if (resolve(options, A.rows()) == SolverMethod::ldlt) {
    return make_ldlt_solver(take(A), options, context);
  }
  return std::make_unique<MultigridSpd>(std::move(A), options, context);
}

std::unique_ptr<SpdSolver> make_solver(const SpdSolverFactory& factory, SparseMatrix A,
                                       const SolverOptions& options, const Context& context) {
  return factory ? factory(take(A), options, context) : make_spd_solver(take(A), options, context);
}

}  // namespace dsc
