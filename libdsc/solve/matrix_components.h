/// \file
/// \internal
/// The connected components of a symmetric matrix's graph, and which of them are singular.
///
/// An entry counts as an edge where |a_ij| > 1e-14 sqrt(a_ii a_jj): explicit zeros and what
/// rounding leaves of them do not connect. A component is singular where each of its rows sums to
/// zero up to 1e-12 of the sum of its absolute values: then constants on the component are in the
/// kernel.
#pragma once

#include "libdsc/solve/sparse_rows.h"

#include <vector>

namespace dsc {

struct MatrixComponents {
  std::vector<int> label;              ///< per row: its component, numbered by lowest row
  std::vector<Index> size;             ///< per component: rows
  std::vector<std::uint8_t> singular;  ///< per component: 0 or 1
  Index singular_count = 0;

  Index count() const { return static_cast<Index>(size.size()); }
};

/// \param a symmetric, finite, its diagonal not negative.
/// \throws SolverError where the entries of a component sum to less than rounding can explain:
///         then A is indefinite.
MatrixComponents matrix_components(RowsView<double> a, const Context& context = {});

/// The mean of x over each singular component (0 for the others). Same bits for any thread count.
std::vector<double> singular_means(const MatrixComponents& components, const double* x,
                                   const Context& context = {});

/// x_i += shift of the component of row i.
void shift_components(const MatrixComponents& components, const std::vector<double>& shift,
                      double* x, const Context& context = {});

}  // namespace dsc
