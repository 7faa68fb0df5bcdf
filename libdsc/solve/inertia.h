/// \file
/// How many eigenvalues of a symmetric matrix are negative, without computing any of them.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/base/types.h"

#include <optional>

namespace dsc {

/// The number of negative eigenvalues of the symmetric n x n matrix A, both triangles stored, by
/// Sylvester's law of inertia: the number of negative pivots of A = P L D Lᵀ Pᵀ. So the number of
/// eigenvalues of A x = μ M x below τ is that of A - τ M.
///
/// Nothing where the answer cannot be trusted: a pivot is lost in rounding, since A is singular or
/// nearly so. A slightly different τ then serves. \throws LimitError where L does not fit in
/// memory.
std::optional<Index> negative_eigenvalues(const SparseMatrix& A, const Context& context = {});

}  // namespace dsc
