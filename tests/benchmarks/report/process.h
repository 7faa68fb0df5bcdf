/// \file
/// Runs a program and tells what it cost.
#pragma once

#include <string>
#include <vector>

namespace report {

struct Finished {
  double seconds = 0;     ///< from start to end
  double peak_bytes = 0;  ///< the most that was resident
};

/// Runs `command` with its output discarded. \throws std::runtime_error where it fails.
Finished run(const std::vector<std::string>& command);

/// The same; returns what it wrote to standard output.
std::string output_of(const std::vector<std::string>& command);

/// A folder of its own for as long as it lives.
class WorkFolder {
 public:
  WorkFolder();
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

}  // namespace report
