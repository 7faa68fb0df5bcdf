/// \file
/// \internal
/// The default direct solver: Eigen's sparse L D Lᵀ with METIS' nested dissection order.
#pragma once

#include "libdsc/solve/spd_solver.h"

namespace dsc {

/// Factorizes A = P L D Lᵀ Pᵀ at once. Only D > 0 is accepted: a pivot at or below the rounding
/// error of its own diagonal entry, (n + 10) epsilon a_ii, means a singular or indefinite matrix.
/// \throws as make_spd_solver does.
std::unique_ptr<SpdSolver> make_ldlt_solver(SparseMatrix A, const SolverOptions& options = {},
                                            const Context& context = {});

}  // namespace dsc
