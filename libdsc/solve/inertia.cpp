#include "libdsc/solve/inertia.h"

#include "libdsc/base/error.h"
#include "libdsc/solve/counted_ldlt.h"

#include <cmath>
#include <limits>
#include <new>
#include <string>

namespace dsc {

std::optional<Index> negative_eigenvalues(const SparseMatrix& A, const Context& context) {
  const Index n = A.rows();
  if (n == 0) return 0;
  CountedLdlt<FillOrder::nested_dissection> ldlt;
  try {
    ldlt.compute(A, context);
  } catch (const std::bad_alloc&) {
    throw LimitError("inertia: the factor of " + std::to_string(n) +
                     " unknowns does not fit in memory");
  }
  if (ldlt.info() != Eigen::Success) return {};
  const Eigen::VectorXd d = ldlt.vectorD();
  const auto& order = ldlt.permutationPinv().indices();
  const Eigen::VectorXd a = A.diagonal();
  const double largest = a.cwiseAbs().maxCoeff();
  const double rounding = static_cast<double>(n + 10) * std::numeric_limits<double>::epsilon();
  Index negative = 0;
  for (Index k = 0; k < n; ++k) {
    const double own = std::abs(a[order.size() > 0 ? order[k] : k]);
    // Without pivoting rounding errors grow with the pivots: a huge one is as bad as a tiny one.
    const bool lost = !(std::abs(d[k]) > rounding * own) || !(std::abs(d[k]) * rounding < largest);
    if (lost) return {};
    if (d[k] < 0) ++negative;
  }
  return negative;
}

}  // namespace dsc
