/// \file
/// A run of the program: what was asked for, how it is going, what is known so far.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/cli/options.h"
#include "libdsc/cli/report.h"

#include <chrono>
#include <optional>
#include <string>

namespace dsc::cli {

struct Run {
  const Options& options;
  Context context;
  Report report;
  std::optional<bool> mesh_projected = {};  ///< set where a mesh file decides the calculus

  bool projected() const { return mesh_projected.value_or(options.projected); }

  /// Goes to the report, and to stderr at the end of the run.
  void warn(std::string message) { report.warnings.push_back(std::move(message)); }
};

/// Adds the wall-clock time of its scope to `seconds`.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds), start_(Clock::now()) {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  double& seconds_;
  Clock::time_point start_;
};

}  // namespace dsc::cli
