/// \file
/// Whole jobs, by the program as a user runs it.
#pragma once

#include "tests/benchmarks/report/figures.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace report {

/// A run of `dsc geodesic` that writes a .vtp file.
struct Job {
  std::string name;
  double faces = 0;
  double seconds = 0;
  double peak_bytes = 0;
  std::map<std::string, double> stages;  ///< seconds, by the names of the program's report
  std::optional<double> error_mean, error_max;
};

struct Jobs {
  std::optional<Job> spot;    ///< R = 6
  std::optional<Job> sphere;  ///< the default radius; in full 5 million faces
  std::optional<Job> large;   ///< R = 6, 10 million faces; in full only
  double help_seconds = 0;    ///< median of 20 starts of dsc --help
  double info_seconds = 0;    ///< of dsc info on a small file

  std::vector<const Job*> all() const;
};

/// `program` is dsc. Spot's voxels are taken from the folder DSC_TEST_DATA, where it is set.
Jobs run_jobs(const std::string& program, Extent extent);

}  // namespace report
