/// \file
/// The solvers that tests go through, CHOLMOD's among them where it is built, and the systems that
/// they get.
#pragma once

#include "libdsc/base/error.h"
#include "libdsc/solve/spd_solver.h"
#ifdef DSC_TEST_CHOLMOD
#include "libdsc/solve/cholmod_solver.h"
#endif
#include "tests/solve/grid_systems.h"
