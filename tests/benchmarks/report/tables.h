/// \file
/// The tables of RESULTS.md.
#pragma once

#include "tests/benchmarks/report/figures.h"
#include "tests/benchmarks/report/jobs.h"

#include <string>

namespace report {

/// `1.23 ms`: three digits, in the unit that suits.
std::string duration(double seconds);

std::string ceilings_table(const Figures& figures);
std::string stages_table(const Figures& figures);
std::string normals_table(const Figures& figures);
std::string jobs_table(const Jobs& jobs);

/// The stages of spot against DGtal's, scaled by the yardstick; empty without spot.
std::string peer_table(const Figures& figures, const Jobs& jobs);

}  // namespace report
