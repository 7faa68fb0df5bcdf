#include "libdsc/solve/cholmod_solver.h"

#include "libdsc/base/error.h"
#include "libdsc/solve/counted_ldlt.h"
#include "libdsc/solve/fill_order.h"

#include <cblas.h>
#include <cholmod.h>

#include <limits>
#include <memory>
#include <string>
#include <utility>

namespace dsc {
namespace {

/// CHOLMOD's settings and workspace: one a call, since a workspace serves one thread at a time.
class Common {
 public:
  Common() {
    cholmod_start(&common_);
    common_.print = 0;  // errors are thrown, not printed
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_GIVEN;
    common_.postorder = 1;
    common_.supernodal = CHOLMOD_AUTO;
    common_.final_ll = 1;
  }
  Common(const Common&) = delete;
  Common& operator=(const Common&) = delete;
  ~Common() { cholmod_finish(&common_); }

  cholmod_common* get() { return &common_; }
  int status() const { return common_.status; }

 private:
  cholmod_common common_;
};

void check_status(const Common& common, Index n) {
  const std::string what =
      "CHOLMOD: the factor of " + std::to_string(n) + " unknowns does not fit ";
  if (common.status() == CHOLMOD_OUT_OF_MEMORY) {
    throw LimitError(what + "in memory; use an iterative method");
  }
  if (common.status() == CHOLMOD_TOO_LARGE) {
    throw LimitError(what + "32-bit indices; use an iterative method");
  }
  if (common.status() < CHOLMOD_OK) {
    throw SolverError("CHOLMOD: failed with status " + std::to_string(common.status()));
  }
}

[[noreturn]] void fail_singular(Index n) {
  throw SolverError("CHOLMOD: the matrix of " + std::to_string(n) +
                    " unknowns is singular or indefinite; a Laplacian needs a fixed vertex in each "
                    "connected component");
}

struct FreeFactor {
  void operator()(cholmod_factor* factor) const {
    Common common;
    cholmod_free_factor(&factor, common.get());
  }
};
using Factor = std::unique_ptr<cholmod_factor, FreeFactor>;

/// The diagonal of L: column by column, or supernode by supernode.
Eigen::VectorXd diagonal_of(const cholmod_factor& L) {
  Eigen::VectorXd diagonal(static_cast<Index>(L.n));
  const auto* x = static_cast<const double*>(L.x);
  if (L.is_super == 0) {
    const int* start = static_cast<const int*>(L.p);
    for (Index k = 0; k < diagonal.size(); ++k) diagonal[k] = x[start[k]];
    return diagonal;
  }
  const int* first = static_cast<const int*>(L.super);
  const int* rows = static_cast<const int*>(L.pi);
  const int* values = static_cast<const int*>(L.px);
  for (std::size_t s = 0; s < L.nsuper; ++s) {
    const Index height = rows[s + 1] - rows[s];
    for (Index k = first[s]; k < first[s + 1]; ++k) {
      diagonal[k] = x[values[s] + (k - first[s]) * (height + 1)];
    }
  }
  return diagonal;
}

/// What the values and rows of an analysed factor are going to take, and the largest block of work.
Index bytes_of(const cholmod_factor& L, Common& common) {
  if (L.is_super == 0) return static_cast<Index>(12 * common.get()->lnz);
  return static_cast<Index>(8 * (L.xsize + L.maxcsize) + 4 * L.ssize);
}

Factor factorize(const SparseMatrix& A, const Context& context) {
  const Index n = A.rows();
  context.need("order unknowns", ordering_bytes(A, FillOrder::nested_dissection));
  const FillPermutation order = fill_order(A, FillOrder::nested_dissection);
  cholmod_sparse view{};  // CHOLMOD reads through pointers to non-const, and writes nothing
  view.nrow = view.ncol = static_cast<std::size_t>(n);
  view.nzmax = static_cast<std::size_t>(A.nonZeros());
  view.p = const_cast<int*>(A.outerIndexPtr());
  view.i = const_cast<int*>(A.innerIndexPtr());
  view.x = const_cast<double*>(A.valuePtr());
  view.stype = -1;  // the lower triangle
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = view.packed = 1;

  Common common;
  Factor factor(
      cholmod_analyze_p(&view, const_cast<int*>(order.indices().data()), nullptr, 0, common.get()));
  check_status(common, n);
  context.check();
  context.need("factorize", bytes_of(*factor, common));
  cholmod_factorize(&view, factor.get(), common.get());
  if (common.status() == CHOLMOD_NOT_POSDEF) fail_singular(n);
  check_status(common, n);

  const Eigen::VectorXd a = A.diagonal();
  const Eigen::VectorXd l = diagonal_of(*factor);
  const int* old_of_new = static_cast<const int*>(factor->Perm);
  const double rounding = static_cast<double>(n + 10) * std::numeric_limits<double>::epsilon();
  for (Index k = 0; k < n; ++k) {
    if (!(l[k] * l[k] > rounding * a[old_of_new[k]])) fail_singular(n);
  }
  return factor;
}

class CholmodSolver final : public SpdSolver {
 public:
  CholmodSolver(SparseMatrix&& A, const SolverOptions& options, const Context& context)
      : SpdSolver(std::move(A), options) {
    openblas_set_num_threads(1);
    context.check();
    if (size() > 0) factor_ = factorize(matrix(), context);
    context.check();
  }

 protected:
  Correction correct(const Eigen::VectorXd& r, double, const Context&) const override {
    if (!factor_) return {r, 0};
    cholmod_dense view{};
    view.nrow = view.nzmax = view.d = static_cast<std::size_t>(r.size());
    view.ncol = 1;
    view.x = const_cast<double*>(r.data());
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    Common common;
    cholmod_dense* x = cholmod_solve(CHOLMOD_A, factor_.get(), &view, common.get());
    check_status(common, size());
    Correction result{Eigen::Map<const Eigen::VectorXd>(static_cast<double*>(x->x), r.size()), 0};
    cholmod_free_dense(&x, common.get());
    return result;
  }

 private:
  Factor factor_;
};

}  // namespace

std::unique_ptr<SpdSolver> make_cholmod_solver(SparseMatrix A, const SolverOptions& options,
                                               const Context& context) {
  return std::make_unique<CholmodSolver>(std::move(A), options, context);
}

}  // namespace dsc
