#include "libdsc/io/memory_limit.h"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>

namespace dsc {
namespace {

namespace fs = std::filesystem;

/// The number at the beginning of a file; nothing where it has none ("max") or is not there.
std::optional<Index> number_in(const fs::path& path) {
  std::ifstream file(path);
  Index value = 0;
  return file >> value ? std::optional<Index>(value) : std::nullopt;
}

/// The number after `key` in a file of lines "key number".
std::optional<Index> number_after(const fs::path& path, const std::string& key) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line.rfind(key, 0) != 0) continue;
    const std::size_t digits = line.find_first_of("0123456789", key.size());
    Index value = 0;
    if (digits != std::string::npos &&
        std::from_chars(line.data() + digits, line.data() + line.size(), value).ec == std::errc{}) {
      return value;
    }
  }
  return std::nullopt;
}

/// The names that the two versions of cgroups have for the same things.
struct CgroupFiles {
  const char *folder, *limit, *used, *cache;
};
constexpr CgroupFiles kVersion1{"sys/fs/cgroup/memory", "memory.limit_in_bytes",
                                "memory.usage_in_bytes", "total_inactive_file "};
constexpr CgroupFiles kVersion2{"sys/fs/cgroup", "memory.max", "memory.current", "inactive_file "};

/// What the cgroup `path` and those around it leave. A container may see its own group as the
/// root, or a path that is not mounted there, so every folder up to the root is asked.
Index cgroup_left(const fs::path& root, const CgroupFiles& files, std::string path) {
  Index left = std::numeric_limits<Index>::max();
  for (;; path.erase(path.rfind('/'))) {
    const fs::path folder = root / files.folder / fs::path(path).relative_path();
    const auto limit = number_in(folder / files.limit);
    const auto used = number_in(folder / files.used);
    if (limit && used) {
      const Index cache = number_after(folder / "memory.stat", files.cache).value_or(0);
      left = std::min(left, std::max<Index>(0, *limit - *used + cache));
    }
    if (path.rfind('/') == std::string::npos) return left;
  }
}

}  // namespace

Index resident_bytes() {
  std::ifstream file("/proc/self/statm");
  Index all = 0, resident = 0;
  return file >> all >> resident ? resident * ::sysconf(_SC_PAGESIZE) : 0;
}

std::optional<Index> available_bytes(const std::string& root) {
  const fs::path top(root.empty() ? "/" : root);
  auto left = number_after(top / "proc/meminfo", "MemAvailable:");
  if (!left || *left > std::numeric_limits<Index>::max() / 1024) return std::nullopt;
  *left *= 1024;
  std::ifstream groups(top / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {  // number:controllers:path
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    const std::string path = line.substr(second + 1);
    if (controllers == ",,") left = std::min(*left, cgroup_left(top, kVersion2, path));
    if (controllers.find(",memory,") != std::string::npos) {
      left = std::min(*left, cgroup_left(top, kVersion1, path));
    }
  }
  return left;
}

std::string bytes_text(Index bytes) {
  constexpr double kMebi = 1024. * 1024;
  const double mebi = static_cast<double>(bytes) / kMebi;
  char text[64];
  (void)std::snprintf(text, sizeof text, mebi < 1024 ? "%.1f MiB" : "%.2f GiB",
                      mebi < 1024 ? mebi : mebi / 1024);
  return text;
}

ProcessMemory::ProcessMemory(Index allowed, std::string by)
    : allowed_(allowed), by_(std::move(by)) {}

ProcessMemory::ProcessMemory()
    : allowed_(std::numeric_limits<Index>::max()), by_("by what this machine has available") {
  if (const auto available = available_bytes()) allowed_ = resident_bytes() + *available;
}

Index ProcessMemory::left() const { return std::max<Index>(0, allowed_ - resident_bytes()); }

void ProcessMemory::need(std::string_view stage, Index bytes) const {
  if (bytes <= left()) return;
  (void)::malloc_trim(0);  // what was freed and kept for later counts as resident until then
  if (bytes <= left()) return;
  throw LimitError("the stage '" + std::string(stage) + "' needs about " + bytes_text(bytes) +
                   " of memory beside the " + bytes_text(resident_bytes()) + " held, and " +
                   bytes_text(allowed_) + " are allowed " + by_ +
                   "; use a coarser grid or a part of the data, or allow more");
}

}  // namespace dsc
