/// \file
/// \internal
/// Orders of the unknowns that keep a sparse Cholesky factor sparse.
#pragma once

#include "libdsc/base/types.h"
#include "libdsc/solve/ldlt_factor.h"

#include <Eigen/Core>

namespace dsc {

/// indices()[k] is the old index of the new unknown k.
using FillPermutation = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;

/// The order of the symmetric matrix A, both triangles stored: the same for the same pattern, every
/// time. \throws LimitError where METIS runs out of memory.
FillPermutation fill_order(const SparseMatrix& A, FillOrder order);

/// The same as a type, which Eigen's factorizations take.
template <FillOrder kOrder>
struct EigenFillOrder {
  using PermutationType = FillPermutation;

  void operator()(const SparseMatrix& A, PermutationType& order) const {
    order = fill_order(A, kOrder);
  }
};

}  // namespace dsc
