#include "libdsc/solve/ldlt_solver.h"

#include "libdsc/base/error.h"

#include <iostream>  // which Eigen/MetisSupport forgets

#include <Eigen/MetisSupport>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>

#include <limits>
#include <mutex>
#include <new>
#include <string>
#include <utility>

namespace dsc {
namespace {

/// METIS' order; approximate minimum degree for systems too small for it to matter. METIS draws
/// from the C library's one random sequence, which it seeds anew at each call: one call at a time,
/// so that the order, and with it every bit of the solution, is always the same.
class NestedDissection {
 public:
  using PermutationType = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;

  template <class Matrix>
  void operator()(const Matrix& A, PermutationType& order) const {
    if (A.cols() < 1000 || A.nonZeros() < 2 * A.cols()) {
      Eigen::AMDOrdering<int>()(A, order);
      return;
    }
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);
    Eigen::MetisOrdering<int>()(A, order);
    if (order.size() != A.cols()) throw LimitError("METIS found no order: out of memory");
  }
};

class LdltSolver final : public SpdSolver {
 public:
  LdltSolver(SparseMatrix A, const SolverOptions& options, const Context& context)
      : SpdSolver(std::move(A), options) {
    if (size() == 0) return;
    context.check();
    try {
      ldlt_.compute(matrix());
    } catch (const std::bad_alloc&) {
      throw LimitError("LDLT: the factor of " + std::to_string(size()) +
                       " unknowns does not fit in memory; use the multigrid method");
    }
    if (ldlt_.info() != Eigen::Success) fail();
    const Eigen::VectorXd diagonal = matrix().diagonal();
    const double rounding =
        static_cast<double>(size() + 10) * std::numeric_limits<double>::epsilon();
    const auto pivots = ldlt_.vectorD();
    const auto& order = ldlt_.permutationPinv().indices();
    for (Index k = 0; k < size(); ++k) {
      if (!(pivots[k] > rounding * diagonal[order.size() > 0 ? order[k] : k])) fail();
    }
    context.check();
  }

 protected:
  Correction correct(const Eigen::VectorXd& r, double) const override {
    return {ldlt_.solve(r), 0};
  }

 private:
  [[noreturn]] void fail() const {
    throw SolverError(
        "LDLT: the matrix of " + std::to_string(size()) +
        " unknowns is singular or indefinite; a Laplacian needs a fixed vertex in each "
        "connected component");
  }

  Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, NestedDissection> ldlt_;
};

}  // namespace

std::unique_ptr<SpdSolver> make_ldlt_solver(SparseMatrix A, const SolverOptions& options,
                                            const Context& context) {
  return std::make_unique<LdltSolver>(std::move(A), options, context);
}

}  // namespace dsc
