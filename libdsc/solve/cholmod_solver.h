/// \file
/// The direct solver on SuiteSparse: CHOLMOD's supernodal L Lᵀ on OpenBLAS (Chen, Davis, Hager,
/// Rajamanickam 2008), several times faster than L D Lᵀ where the factor is large. Of the target
/// dsc::cholmod, which the option DSC_WITH_CHOLMOD builds; CHOLMOD's supernodal part is GPL.
///
///     dsc::GeodesicOptions options;
///     options.factory = dsc::make_cholmod_solver;
#pragma once

#include "libdsc/solve/spd_solver.h"

namespace dsc {

/// Factorizes A = P L Lᵀ Pᵀ in the order of the LDLT solver. `options.method` is not looked at.
/// Sets OpenBLAS, for the whole process, to one thread: more would change the last bits with their
/// number. A pivot at or below the rounding error of its own diagonal entry, (n + 10) epsilon a_ii,
/// means a singular or indefinite matrix. \throws as make_spd_solver does.
std::unique_ptr<SpdSolver> make_cholmod_solver(SparseMatrix A, const SolverOptions& options = {},
                                               const Context& context = {});

}  // namespace dsc
