/// \file
/// \internal
/// The coarse space of one multigrid level: aggregates of strongly coupled unknowns and the
/// smoothed prolongation from them.
///
/// Couplings: a_ij < 0 is strong where |a_ij| >= strength * min(m_i, m_j), m_i = max_k(-a_ik). So
/// positive couplings are never strong (across them the solution may jump), and every row with a
/// negative coupling has a strong one.
/// Prolongation: row i is (1 - w) e_agg(i) + w sum_j |a_ij| e_agg(j) / sum_j |a_ij| over the strong
/// couplings j: one damped Jacobi step on the matrix filtered to them, its diagonal lumped so that
/// rows sum to zero. Hence P >= 0 and P 1 = 1: constants stay exactly representable.
#pragma once

#include "libdsc/solve/sparse_rows.h"

namespace dsc {

struct Aggregates {
  std::vector<int> of;  ///< per row: its aggregate, or -1: left to the smoother
  Index count = 0;
};

/// Rows left to the smoother: those without negative couplings and those whose diagonal is at least
/// 5 times the sum of all their couplings (singular single unknowns among them). Every other row is
/// in an aggregate. Deterministic: greedy in the order of rows.
Aggregates aggregate(RowsView<double> a, const std::vector<double>& diagonal, double strength,
                     const Context& context);

/// a.rows x aggregates.count, entries as above; empty rows where no aggregate.
SparseRows<float> smoothed_prolongation(RowsView<double> a, const Aggregates& aggregates,
                                        double strength, double weight, const Context& context);

/// The Galerkin product P^T A P. \param transposed P^T.
SparseRows<double> galerkin_product(RowsView<double> a, const SparseRows<float>& prolongation,
                                    const SparseRows<float>& transposed, const Context& context);

}  // namespace dsc
