/// \file
/// What a sparse matrix takes, and how it is passed on without taking it twice: Eigen 3.4's
/// SparseMatrix has no move constructor, so that std::move copies.
#pragma once

#include "libdsc/base/types.h"

#include <memory>

namespace dsc {

/// `from`, which is left empty.
inline SparseMatrix take(SparseMatrix& from) {
  SparseMatrix to;
  to.swap(from);
  return to;
}

/// The same, to be shared.
inline std::shared_ptr<const SparseMatrix> share(SparseMatrix& from) {
  const auto to = std::make_shared<SparseMatrix>();
  to->swap(from);
  return to;
}

/// Bytes of a compressed matrix of this many columns and nonzeros.
inline Index matrix_bytes(Index columns, Index nonzeros) {
  return nonzeros * static_cast<Index>(sizeof(double) + sizeof(int)) +
         columns * static_cast<Index>(sizeof(int));
}
/// The same of a matrix that is there.
inline Index matrix_bytes(const SparseMatrix& A) { return matrix_bytes(A.cols(), A.nonZeros()); }

}  // namespace dsc
