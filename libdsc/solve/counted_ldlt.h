/// \file
/// \internal
/// Eigen's sparse L D Lᵀ in two steps, so that the factor is counted before it is made. Private to
/// solve/.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/solve/fill_order.h"
#include "libdsc/solve/matrix_memory.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <new>

namespace dsc {

/// What the ordering of a matrix's unknowns takes at most: the matrix with both its triangles, its
/// transpose, its graph, and METIS' coarser graphs and separators.
inline Index ordering_bytes(const SparseMatrix& A, FillOrder order) {
  return order == FillOrder::nested_dissection ? 60 * A.nonZeros() + 100 * A.cols()
                                               : 24 * A.nonZeros() + 40 * A.cols();
}

/// What L, D and the permuted triangle of A take.
inline Index factor_bytes(const SparseMatrix& A, Index fill) {
  return matrix_bytes(A.cols(), fill) + matrix_bytes(A.cols(), A.nonZeros() / 2 + A.cols()) +
         56 * A.cols();
}

template <FillOrder kOrder>
class CountedLdlt
    : public Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, EigenFillOrder<kOrder>> {
 public:
  /// \throws LimitError where the context's memory does not hold the factor; std::bad_alloc where
  /// memory or 32-bit indices do not.
  void compute(const SparseMatrix& A, const Context& context) {
    context.need("order unknowns", ordering_bytes(A, kOrder));
    this->analyzePattern(A);
    const int* start = this->m_matrix.outerIndexPtr();
    // Eigen counts in 32 bits, and a count that wraps falls.
    if (!std::is_sorted(start, start + A.cols() + 1)) throw std::bad_alloc();
    context.need("factorize", factor_bytes(A, start[A.cols()]));
    this->factorize(A);
  }
};

}  // namespace dsc
