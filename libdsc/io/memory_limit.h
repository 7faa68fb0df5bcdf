/// \file
/// How much memory this process holds, and how much it may take.
#pragma once

#include "libdsc/base/context.h"

#include <optional>
#include <string>

namespace dsc {

/// The memory that this process holds now, in bytes: its resident set. 0 where the system does not
/// say.
Index resident_bytes();

/// What the system could still give without killing anybody: MemAvailable of /proc/meminfo, or less
/// where a cgroup (a container) leaves less. Nothing where the system does not say.
/// \param root the folder that has /proc and /sys.
std::optional<Index> available_bytes(const std::string& root = "");

/// "812 MiB", "3.4 GiB".
std::string bytes_text(Index bytes);

/// The limit of a whole process: what is resident and what a stage asks for must not pass it.
class ProcessMemory final : public MemoryLimit {
 public:
  /// `allowed` bytes in all, `by` whom in the message: "by --max-memory".
  ProcessMemory(Index allowed, std::string by);
  /// What is held now and what the system has available.
  ProcessMemory();

  void need(std::string_view stage, Index bytes) const override;
  Index left() const override;

 private:
  Index allowed_;
  std::string by_;
};

}  // namespace dsc
