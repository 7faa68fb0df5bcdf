/// \file
/// What was aimed at, and whether it was reached.
#pragma once

#include "tests/benchmarks/report/figures.h"
#include "tests/benchmarks/report/jobs.h"

#include <string>

namespace report {

std::string reach_table(const Figures& figures, const Jobs& jobs);

}  // namespace report
