// What is left behind when a run fails or is interrupted: what was there before.
#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

#include <fcntl.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

namespace dsc::test {
namespace {

const Words kSurface = {"surface", "shape:sphere", "--gridstep", "0.05"};

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(Failure, AnExistingFileSurvivesAWriteThatFails) {
  Words endings = {"ply", "vtp", "csv", "off", "obj", "stl", "om", "glb"};
  for (const char* ending : {"vol", "longvol", "npy", "vti"}) endings.emplace_back(ending);
  for (const std::string& ending : endings + seen_endings()) {
    SCOPED_TRACE(ending);
    const Folder folder;
    const std::string name = "s." + ending;
    write_file(folder / name, "old");
    const bool voxels = ending == "vti" || ending == "npy" || ending.find("vol") < ending.size();
    Words command = kSurface;
    if (voxels) command[0] = "voxels";
    // Compressed voxels are few bytes.
    const rlim_t bytes = voxels ? 500 : 20000;
    const Outcome outcome = run_dsc(with(command, {"-o", folder / name}), [&] {
      const rlimit limit{bytes, bytes};  // that a file may have
      ::setrlimit(RLIMIT_FSIZE, &limit);
    });
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    EXPECT_NE(outcome.err.find(name), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("File too large"), std::string::npos) << outcome.err;
    EXPECT_EQ(read_file(folder / name), "old");
    EXPECT_EQ(folder.names(), Words{name});
  }
}

TEST(Failure, AFullDeviceIsAnError) {
  const Folder folder;
  ASSERT_EQ(::symlink("/dev/full", (folder / "s.csv").c_str()), 0);
  const Outcome outcome = run_dsc(with(kSurface, {"-o", folder / "s.csv"}));
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("s.csv"), std::string::npos) << outcome.err;
}

TEST(Failure, AFullStandardOutputIsAnError) {
  const Outcome outcome = run_dsc({"info", "shape:sphere", "--gridstep", "0.1"},
                                  [] { ::dup2(::open("/dev/full", O_WRONLY), STDOUT_FILENO); });
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
}

TEST(Failure, AMissingFolderIsFoundBeforeTheInputIsRead) {
  const Folder folder;
  for (const char* option : {"--output", "--report"}) {
    const Outcome outcome = run_dsc(
        {"surface", "missing.vol", "-o", folder / "a.ply", option, folder / "nowhere/b.ply"});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_NE(outcome.err.find("nowhere"), std::string::npos) << outcome.err;
  }
}

TEST(Failure, AFailingRunWritesNoReport) {
  const Folder folder;
  write_file(folder / "r.json", "old");
  EXPECT_EQ(run_dsc({"info", folder / "missing.vol", "--report", folder / "r.json"}).exit_code, 3);
  EXPECT_EQ(read_file(folder / "r.json"), "old");
}

TEST(Failure, ASolverThatFailsIsExitCodeFiveAndLeavesNothing) {
  // A weight that doubles cannot hold beside the other terms of the system.
  for (const Words& extremes : {Words{"geodesic", "--lambda", "1e-300"},
                                Words{"geodesic", "--calculus", "naive", "--lambda", "1e-300"}}) {
    const Folder folder;
    const Outcome outcome =
        run_dsc(with(extremes, {"shape:sphere", "--gridstep", "0.1", "--source", "0,0,1", "-o",
                                folder / "w.ply", "--report", folder / "r.json"}));
    EXPECT_EQ(outcome.exit_code, 5) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find("matrix"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("--lambda 1e-300"), std::string::npos) << outcome.err;
    EXPECT_EQ(folder.names(), Words{});
  }
}

TEST(Quiet, PrintsNothing) {
  const Outcome outcome = run_dsc({"info", "shape:sphere", "--gridstep", "0.1", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

/// Waits until the program takes its signals itself; before main() nothing can be left behind.
void wait_until_watching(int child) {
  for (int i = 0; i < 2000; ++i) {
    const std::string status = read_file("/proc/" + std::to_string(child) + "/status");
    const std::size_t at = status.find("SigBlk:");
    const auto blocked = std::stoull(status.substr(at + 7), nullptr, 16);
    if ((blocked >> (SIGINT - 1) & 1) != 0) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  FAIL() << "the program does not watch for signals";
}

/// A run of some seconds.
Words long_run(const Folder& folder) {
  return {
      "geodesic",       "shape:sphere", "--gridstep",     "0.004",    "--source-vertex", "0", "-o",
      folder / "d.ply", "-o",           folder / "d.csv", "--report", folder / "r.json"};
}

TEST(Interruption, EndsWithinASecondAndLeavesNothingBehind) {
  for (const int signal : {SIGINT, SIGTERM}) {
    for (const int milliseconds : {0, 200, 600}) {
      const Folder folder;
      std::chrono::steady_clock::time_point sent;
      const Outcome outcome = run_dsc(long_run(folder), {}, [&](int child) {
        wait_until_watching(child);
        std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
        sent = std::chrono::steady_clock::now();
        ::kill(child, signal);
      });
      EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
      EXPECT_EQ(outcome.out, "");
      EXPECT_NE(outcome.err.find("dsc: interrupted"), std::string::npos) << outcome.err;
      EXPECT_EQ(folder.names(), Words{});
      // A machine under load may take longer than the second that the program allows itself.
      EXPECT_LT(std::chrono::steady_clock::now() - sent, std::chrono::seconds(10));
    }
  }
}

TEST(Interruption, WhileFilesAreWrittenLeavesWholeFilesOnly) {
  const Words command = {"surface", "shape:sphere", "--gridstep", "0.008"};
  const Folder whole;
  ASSERT_EQ(run_dsc(with(command, {"-o", whole / "s.csv"})).exit_code, 0);
  const auto size = read_file(whole / "s.csv").size();
  for (int milliseconds = 20; milliseconds < 500; milliseconds += 60) {
    const Folder folder;
    const Outcome outcome = run_dsc(with(command, {"-o", folder / "s.csv"}), {}, [&](int child) {
      wait_until_watching(child);
      std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
      ::kill(child, SIGINT);
    });
    EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 130) << outcome.exit_code;
    if (outcome.exit_code == 0) {
      EXPECT_EQ(folder.names(), Words{"s.csv"});
    }
    for (const std::string& name : folder.names()) {
      EXPECT_EQ(name, "s.csv");
      EXPECT_EQ(read_file(folder / name).size(), size);
    }
  }
}

TEST(Progress, IsDrawnOnATerminalOnly) {
  const Words command = {"surface", "shape:sphere", "--gridstep", "0.003", "-o"};
  const Folder folder;
  EXPECT_EQ(run_dsc(with(command, {folder / "s.csv"})).err, "");

  for (const bool quiet : {false, true}) {
    const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY);
    ASSERT_GE(terminal, 0);
    ASSERT_EQ(::grantpt(terminal), 0);
    ASSERT_EQ(::unlockpt(terminal), 0);
    const std::string name = ::ptsname(terminal);
    const int keep_open = ::open(name.c_str(), O_RDWR | O_NOCTTY);
    Words words = with(command, {folder / "s.csv"});
    if (quiet) words.push_back("--quiet");
    const Outcome outcome = run_dsc(words, [&] { ::dup2(keep_open, STDERR_FILENO); });
    EXPECT_EQ(outcome.exit_code, 0);
    ::fcntl(terminal, F_SETFL, O_NONBLOCK);
    std::string drawn;
    char part[4096];  // a terminal gives no more at once
    for (ssize_t n = 0; (n = ::read(terminal, part, sizeof part)) > 0;) {
      drawn.append(part, static_cast<std::size_t>(n));
    }
    EXPECT_EQ(drawn.find('\r') != std::string::npos, !quiet) << drawn;
    if (!quiet) {
      EXPECT_EQ(drawn.substr(drawn.size() - 4), "\r\033[K") << "the bar was not removed";
    }
    ::close(keep_open);
    ::close(terminal);
  }
}

}  // namespace
}  // namespace dsc::test
