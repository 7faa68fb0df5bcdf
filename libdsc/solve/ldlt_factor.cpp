#include "libdsc/solve/ldlt_factor.h"

#include "libdsc/base/error.h"
#include "libdsc/solve/counted_ldlt.h"

#include <limits>
#include <new>
#include <string>

namespace dsc {
namespace {

/// The factor in the form that the solves read.
struct View {
  Index n = 0;
  const int* start = nullptr;  ///< of each column of L, in rows and values
  const int* rows = nullptr;
  const double* values = nullptr;
  const double* diagonal = nullptr;
  const int* old_of_new = nullptr;  ///< null: the order of A
};

[[noreturn]] void fail(Index n) {
  throw SolverError("LDLT: the matrix of " + std::to_string(n) +
                    " unknowns is singular or indefinite; a Laplacian needs a fixed vertex in each "
                    "connected component");
}

}  // namespace

struct LdltFactor::Data {
  virtual ~Data() = default;
  virtual Eigen::VectorXd solve(const Eigen::VectorXd& b) const = 0;
  View view;
  Eigen::VectorXd diagonal;
};

namespace {

template <FillOrder kOrder, class Base>
struct Factor final : Base {
  Factor(const SparseMatrix& A, const Context& context) {
    const Index n = A.rows();
    try {
      ldlt.compute(A, context);
    } catch (const std::bad_alloc&) {
      throw LimitError("LDLT: the factor of " + std::to_string(n) +
                       " unknowns does not fit in memory; use an iterative method");
    }
    if (ldlt.info() != Eigen::Success) fail(n);
    this->diagonal = ldlt.vectorD();
    const auto& L = ldlt.matrixL().nestedExpression();
    const auto& order = ldlt.permutationPinv().indices();
    this->view = {n,
                  L.outerIndexPtr(),
                  L.innerIndexPtr(),
                  L.valuePtr(),
                  this->diagonal.data(),
                  order.size() > 0 ? order.data() : nullptr};
    const Eigen::VectorXd a = A.diagonal();
    const double rounding = static_cast<double>(n + 10) * std::numeric_limits<double>::epsilon();
    for (Index k = 0; k < n; ++k) {
      const Index old = this->view.old_of_new != nullptr ? this->view.old_of_new[k] : k;
      if (!(this->diagonal[k] > rounding * a[old])) fail(n);
    }
  }
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const override { return ldlt.solve(b); }

  CountedLdlt<kOrder> ldlt;
};

}  // namespace

LdltFactor::LdltFactor(const SparseMatrix& A, FillOrder order, const Context& context) {
  if (A.rows() == 0) return;
  if (order == FillOrder::nested_dissection) {
    data_ = std::make_unique<Factor<FillOrder::nested_dissection, Data>>(A, context);
  } else {
    data_ = std::make_unique<Factor<FillOrder::minimum_degree, Data>>(A, context);
  }
}
LdltFactor::~LdltFactor() = default;
LdltFactor::LdltFactor(LdltFactor&&) noexcept = default;
LdltFactor& LdltFactor::operator=(LdltFactor&&) noexcept = default;

Index LdltFactor::size() const { return data_ ? data_->view.n : 0; }
Index LdltFactor::fill() const { return data_ ? data_->view.start[data_->view.n] : 0; }

Eigen::VectorXd LdltFactor::solve(const Eigen::VectorXd& b) const {
  return data_ ? data_->solve(b) : b;
}

void LdltFactor::solve_in_place(WideVector& b) const {
  if (!data_) return;
  const View& f = data_->view;
  std::vector<Wide> x(static_cast<std::size_t>(f.n));
  const auto old = [&](Index k) { return f.old_of_new != nullptr ? f.old_of_new[k] : k; };
  for (Index k = 0; k < f.n; ++k) x[static_cast<std::size_t>(k)] = b[old(k)];
  for (Index k = 0; k < f.n; ++k) {
    Wide& xk = x[static_cast<std::size_t>(k)];
    if (xk.mantissa == 0) continue;
    xk.normalise();
    for (int p = f.start[k]; p < f.start[k + 1]; ++p) {
      x[static_cast<std::size_t>(f.rows[p])].add(-f.values[p] * xk.mantissa, xk.exponent);
    }
  }
  for (Index k = f.n - 1; k >= 0; --k) {
    Wide xk = x[static_cast<std::size_t>(k)];
    xk.mantissa /= f.diagonal[k];
    for (int p = f.start[k]; p < f.start[k + 1]; ++p) {
      const Wide& xi = x[static_cast<std::size_t>(f.rows[p])];
      xk.add(-f.values[p] * xi.mantissa, xi.exponent);
    }
    xk.normalise();
    x[static_cast<std::size_t>(k)] = xk;
  }
  for (Index k = 0; k < f.n; ++k) b.set(old(k), x[static_cast<std::size_t>(k)]);
}

}  // namespace dsc
