// Runs that end at any moment or whose disk, folder or permission goes: the old file or the new
// one, whole, and an exit code other than 0 unless it is the new one.
#include "tests/cli/program.h"
#include "tests/support/long_tests.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <random>
#include <thread>

#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace dsc::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

const Words kJob = {"surface", "shape:sphere", "--gridstep", "0.01", "--quiet"};

bool is_temporary(const std::string& name) { return name.find(".tmp-") != std::string::npos; }

/// Waits until a temporary is in `folder`. False where the program has ended before.
bool wait_for_temporary(const Folder& folder, int child) {
  while (true) {
    const Words names = folder.names();
    if (std::any_of(names.begin(), names.end(), is_temporary)) return true;
    if (has_ended(child)) return false;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
}

/// Random bytes, which no writer compresses, in a cube of n^3 voxels.
void write_noise(const std::string& path, int n) {
  const std::string side = std::to_string(n);
  std::string voxels = "X: " + side + "\nY: " + side + "\nZ: " + side + "\nVersion: 2\n.\n";
  std::mt19937 random(5);
  for (int i = 0; i < n * n * n; ++i) voxels += static_cast<char>(random());
  write_file(path, voxels);
}

TEST(Killed, AtAnyMomentTheOldFileOrTheNewOneIsThereWhole) {
  const int runs = testing::usually_or_long(40, 1000);
  std::mt19937 random(1);
  int killed = 0, killed_while_writing = 0, new_files = 0;
  const Folder inputs;
  write_noise(inputs / "noise.vol", 180);
  Words names = {"s.ply", "s.vtp", "s.glb", "s.vol"};
  const Words seen = seen_endings();
  if (std::find(seen.begin(), seen.end(), "html") != seen.end()) names.emplace_back("s.html");
  const int of_one = runs / static_cast<int>(names.size());
  for (const std::string& name : names) {
    const Words job = name == "s.vol"
                          ? Words{"voxels", inputs / "noise.vol", "--labels", "all", "--quiet"}
                          : kJob;
    int written = 0;
    const Folder whole;
    const auto start = Clock::now();
    ASSERT_EQ(run_dsc(job + Words{"-o", whole / name}).exit_code, 0);
    const auto duration = Clock::now() - start;
    const std::string truth = read_file(whole / name);
    const Folder folder;  // one for all runs: what one leaves must not harm the next
    for (int run = 0; run < of_one || (written == 0 && run < 5 * of_one); ++run) {
      const bool there = run % 2 == 0;
      fs::remove(folder / name);
      if (there) write_file(folder / name, "old");
      if (run % 5 != 4) {
        for (const std::string& left : folder.names()) {
          if (is_temporary(left)) fs::remove(folder / left);
        }
      }
      const Words before = folder.names();
      // Half of them while the file is written, which takes a small part of the time.
      const bool at_the_file = run % 4 < 2;
      const double part =
          std::uniform_real_distribution<double>(0, at_the_file ? 0.15 : 1.1)(random);
      const Outcome outcome = run_dsc(job + Words{"-o", folder / name}, {}, [&](int child) {
        if (at_the_file && std::none_of(before.begin(), before.end(), is_temporary)) {
          wait_for_temporary(folder, child);
        }
        std::this_thread::sleep_for(part * duration);
        ::kill(child, SIGKILL);
      });
      ASSERT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 128 + SIGKILL) << outcome.err;
      killed += outcome.exit_code != 0 ? 1 : 0;
      const Words after = folder.names();
      written += std::count_if(after.begin(), after.end(), is_temporary) >
                         std::count_if(before.begin(), before.end(), is_temporary)
                     ? 1
                     : 0;
      const bool exists = fs::exists(folder / name);
      const std::string content = exists ? read_file(folder / name) : "";
      const bool is_new = content == truth;
      new_files += is_new ? 1 : 0;
      ASSERT_TRUE(is_new || (there ? content == "old" : !exists))
          << "run " << run << ": " << content.size();
      ASSERT_TRUE(is_new || outcome.exit_code != 0) << "run " << run;
      for (const std::string& left : after) ASSERT_TRUE(left == name || is_temporary(left)) << left;
    }
    EXPECT_EQ(run_dsc(job + Words{"-o", folder / name}).exit_code, 0);
    EXPECT_TRUE(read_file(folder / name) == truth);
    EXPECT_GT(written, 0) << name << ": no file was under way";
    killed_while_writing += written;
  }
  std::printf("%d runs: %d killed, %d of them with a file under way; %d new files\n", runs, killed,
              killed_while_writing, new_files);
  EXPECT_GT(killed_while_writing, runs / 10);  // else nothing was tried
}

/// A small disk of its own; needs root.
class SmallDisk {
 public:
  explicit SmallDisk(const std::string& path, const char* size) : path_(path) {
    ::mkdir(path.c_str(), 0777);
    there_ = ::mount("tmpfs", path.c_str(), "tmpfs", 0, size) == 0;
  }
  ~SmallDisk() {
    if (there_) ::umount2(path_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  bool there() const { return there_; }

 private:
  std::string path_;
  bool there_;
};

TEST(Killed, AFullDiskKeepsTheOldFile) {
  const Folder folder;
  const SmallDisk disk(folder / "disk", "size=256k");
  if (!disk.there()) GTEST_SKIP() << "no disk can be mounted here; root may";
  const std::string input = folder / "random.vol";
  write_noise(input, 100);
  const auto expect_kept = [&](const std::string& ending, const Words& job) {
    const std::string path = folder / ("disk/s." + ending);
    write_file(path, "old");
    const Outcome outcome = run_dsc(job + Words{"-o", path});
    EXPECT_EQ(outcome.exit_code, 3) << ending;
    EXPECT_NE(outcome.err.find("s." + ending), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("No space left"), std::string::npos) << outcome.err;
    EXPECT_EQ(read_file(path), "old");
    fs::remove(path);
    EXPECT_TRUE(fs::is_empty(folder / "disk")) << ending;
  };
  for (const std::string ending : {"ply", "vtp", "csv", "off", "obj", "stl", "om", "glb"}) {
    expect_kept(ending, kJob);
  }
  for (const std::string ending : {"vol", "longvol", "npy", "vti"}) {
    expect_kept(ending, {"voxels", input, "--labels", "all", "--quiet"});
  }
  for (const std::string& ending : seen_endings()) {
    Words job = kJob;
    if (ending == "png") job = job + Words{"--picture-size", "2000,2000"};
    expect_kept(ending, job);
  }
}

TEST(Killed, AReportThatCannotBeWrittenIsAnErrorAfterWholeResults) {
  const Folder folder;
  ASSERT_EQ(::symlink("/dev/full", (folder / "r.json").c_str()), 0);
  const Outcome outcome = run_dsc({"surface", "shape:sphere", "--gridstep", "0.1", "-o",
                                   folder / "s.ply", "--report", folder / "r.json"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("r.json"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(folder.names(), (Words{"r.json", "s.ply"}));
}

struct Round {
  bool tried = false;    ///< the folder went in time, and this user could be locked out
  bool skipped = false;  ///< there is no other user here
};

/// One run whose folder is removed, moved or shut meanwhile: before or while its file is written.
Round lose_folder(const std::string& how, bool writing) {
  constexpr uid_t kNobody = 65534;
  const bool root = ::geteuid() == 0;
  const Folder folder;
  const Folder sub_of;  // watched through its own names
  const std::string target = sub_of / "";
  ::chmod(target.c_str(), 0777);
  write_file(sub_of / "s.ply", "old");
  ::chmod((sub_of / "s.ply").c_str(), 0666);
  const auto in_child = [&] {
    if (how == "shut" && root && ::setuid(kNobody) != 0) ::_exit(126);
  };
  bool in_time = true;
  std::string content;
  const std::string moved = folder / "moved";
  const Outcome outcome = run_dsc(kJob + Words{"-o", sub_of / "s.ply"}, in_child, [&](int child) {
    if (writing) {
      in_time = wait_for_temporary(sub_of, child);
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(60));
    }
    const std::string from = target.substr(0, target.size() - 1);
    if (how == "shut") {
      ::chmod(from.c_str(), 0555);
      return;
    }
    // Moved first: from then on what is in it is all that there will be.
    fs::rename(from, moved);
    content = read_file(moved + "/s.ply");
    if (how == "removed") fs::remove_all(moved);
  });
  ::chmod(target.c_str(), 0777);
  if (outcome.exit_code == 126 || outcome.exit_code == 127) return {false, true};
  if (how == "shut") content = read_file(sub_of / "s.ply");
  if (how == "moved") {
    EXPECT_TRUE(read_file(moved + "/s.ply") == content);
  }
  EXPECT_EQ(fs::exists(sub_of / "s.ply"), how == "shut");
  if (outcome.exit_code == 0) {  // it was faster
    EXPECT_GT(content.size(), 1000000U);
    return {};
  }
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_NE(outcome.err.find("s.ply"), std::string::npos) << outcome.err;
  EXPECT_EQ(content, "old");
  EXPECT_TRUE(in_time);
  return {true};
}

/// The checks before the run have passed; the folder goes later.
TEST(Killed, AFolderThatVanishesOrIsShutMeanwhileIsAnError) {
  for (const std::string how : {"removed", "moved", "shut"}) {
    for (const bool writing : {false, true}) {
      if (how == "shut" && writing) continue;  // a file that is open stays so
      SCOPED_TRACE(how + (writing ? " while it is written" : " before"));
      Round round;
      for (int i = 0; i < 10 && !round.tried && !round.skipped; ++i) {
        round = lose_folder(how, writing);
      }
      EXPECT_TRUE(round.tried || round.skipped) << "each run was faster: nothing was tried";
    }
  }
}

}  // namespace
}  // namespace dsc::test
