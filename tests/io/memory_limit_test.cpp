#include "libdsc/io/memory_limit.h"
#include "tests/io/temporary_folder.h"

#include <gtest/gtest.h>

#include <vector>

#include <malloc.h>

namespace dsc {
namespace {

constexpr Index kMebi = 1 << 20;

/// A system made up of files.
class System {
 public:
  System() { put("proc/meminfo", "MemTotal: 99 kB\nMemAvailable:    4096 kB\nMemFree: 7 kB\n"); }
  void put(const std::string& name, const std::string& text) {
    const std::filesystem::path path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    write_all(path, text);
  }
  std::optional<Index> available() const { return available_bytes(folder_.path()); }

 private:
  TemporaryFolder folder_;
};

TEST(AvailableBytes, IsWhatTheMachineHas) {
  EXPECT_EQ(System().available(), 4096 * 1024);
  System none;
  none.put("proc/meminfo", "MemTotal: 99 kB\n");
  EXPECT_EQ(none.available(), std::nullopt);
  const auto here = available_bytes();
  ASSERT_TRUE(here);
  EXPECT_GT(*here, kMebi);
}

TEST(AvailableBytes, IsWhatTheContainerLeaves) {
  System system;
  system.put("proc/self/cgroup", "0::/a/b\n");
  system.put("sys/fs/cgroup/a/b/memory.max", "max\n");
  system.put("sys/fs/cgroup/a/b/memory.current", "1000\n");
  EXPECT_EQ(system.available(), 4096 * 1024);
  system.put("sys/fs/cgroup/a/b/memory.max", "3000\n");
  EXPECT_EQ(system.available(), 2000);
  system.put("sys/fs/cgroup/a/b/memory.stat", "anon 5\ninactive_file 300\nactive_file 9\n");
  EXPECT_EQ(system.available(), 2300) << "files in memory make room";
  system.put("sys/fs/cgroup/a/memory.max", "1700");
  system.put("sys/fs/cgroup/a/memory.current", "1200");
  EXPECT_EQ(system.available(), 500) << "the group around it";
  system.put("sys/fs/cgroup/memory.max", "10");
  system.put("sys/fs/cgroup/memory.current", "20");
  EXPECT_EQ(system.available(), 0) << "a container that sees itself as the root";
}

TEST(AvailableBytes, KnowsTheFirstVersionOfGroupsToo) {
  System system;
  system.put("proc/self/cgroup", "3:cpu,cpuacct:/x\n2:memory:/x\n0::/\n");
  system.put("sys/fs/cgroup/memory/x/memory.limit_in_bytes", "5000\n");
  system.put("sys/fs/cgroup/memory/x/memory.usage_in_bytes", "1000\n");
  EXPECT_EQ(system.available(), 4000);
  system.put("sys/fs/cgroup/memory/x/memory.limit_in_bytes", "9223372036854771712\n");
  EXPECT_EQ(system.available(), 4096 * 1024);
}

TEST(ProcessMemory, RefusesWhatPassesItInASentence) {
  (void)::malloc_trim(0);
  const Index held = resident_bytes();
  ASSERT_GT(held, kMebi);
  const ProcessMemory limit(held + 64 * kMebi, "by the test");
  EXPECT_NO_THROW(limit.need("small", 16 * kMebi));
  EXPECT_LE(limit.left(), 65 * kMebi);
  EXPECT_GE(limit.left(), 32 * kMebi);
  try {
    limit.need("a stage", 3000 * kMebi);
    FAIL() << "nothing was thrown";
  } catch (const LimitError& error) {
    for (const char* part : {"'a stage'", "2.93 GiB", "allowed by the test", "coarser"}) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }
  // What is held counts.
  const std::vector<char> taken(60 * kMebi, 1);
  EXPECT_THROW(limit.need("small", 16 * kMebi), LimitError);
  EXPECT_EQ(ProcessMemory(kMebi, "by the test").left(), 0);
}

TEST(ProcessMemory, WithoutALimitIsTheMachine) {
  EXPECT_NO_THROW(ProcessMemory().need("small", kMebi));
  EXPECT_THROW(ProcessMemory().need("large", Index{1} << 60), LimitError);
}

TEST(BytesText, IsShort) {
  EXPECT_EQ(bytes_text(0), "0.0 MiB");
  EXPECT_EQ(bytes_text(1536 * 1024), "1.5 MiB");
  EXPECT_EQ(bytes_text(Index{5} << 28), "1.25 GiB");
}

}  // namespace
}  // namespace dsc
