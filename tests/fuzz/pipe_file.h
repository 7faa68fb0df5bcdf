/// \file
/// A path to write to whose bytes land in memory, without a disk in between.
#pragma once

#include <string>
#include <string_view>

namespace dsc::fuzz {

/// A link `fuzz<ending>` to a pipe of this process, in a folder of its own. Results to pipes are
/// written directly.
class PipeFile {
 public:
  explicit PipeFile(const std::string& ending);
  PipeFile(const PipeFile&) = delete;
  PipeFile& operator=(const PipeFile&) = delete;
  ~PipeFile();

  const std::string& path() const { return path_; }
  /// What was written since the last call; at most 1 MB.
  const std::string& take();

 private:
  std::string folder_, path_, bytes_;
  int ends_[2] = {-1, -1};
};

}  // namespace dsc::fuzz
