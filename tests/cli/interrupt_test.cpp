// Ctrl-C at random moments of a run through many stages, while files are written, twice, and with a
// reader at work: the program ends within a second and leaves whole files only.
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

#include <stdlib.h>

namespace dsc::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

TEST(Interrupt, AtRandomMomentsLeavesWholeFilesOnly) {
  const Words job = {"geodesic", "shape:sphere", "--gridstep", "0.03",
                     "--source", "0,0,1",        "--quiet"};
  const Words names = {"r.csv", "r.json", "r.ply", "r.vtp"};
  const auto in = [&](const Folder& folder) {
    Words words = job;
    for (const std::string& name : names) {
      words.insert(words.end(), {name == "r.json" ? "--report" : "-o", folder / name});
    }
    return words;
  };
  const Folder whole;
  const auto start = Clock::now();
  ASSERT_EQ(run_dsc(in(whole)).exit_code, 0);
  const auto duration = Clock::now() - start;
  std::mt19937 random(7);
  const int runs = testing::usually_or_long(25, 500);
  int interrupted = 0;
  Clock::duration longest{};
  for (int run = 0; run < runs; ++run) {
    const Folder folder;
    // Half of them towards the end, where files are written.
    const double part =
        std::uniform_real_distribution<double>(run % 2 == 0 ? 0. : 0.8, 1.05)(random);
    Clock::time_point sent;
    const Outcome outcome = run_dsc(in(folder), {}, [&](int child) {
      std::this_thread::sleep_for(part * duration);
      sent = Clock::now();
      ::kill(child, SIGINT);
    });
    longest = std::max(longest, Clock::now() - sent);
    const Words there = folder.names();
    // Before main() takes the signal over, the system's own end: nothing can be left then.
    const bool before_main =
        outcome.exit_code == 128 + SIGINT && there.empty() && outcome.err.empty();
    ASSERT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 130 || before_main)
        << outcome.exit_code << ": " << outcome.err;
    if (outcome.exit_code == 0) {
      ASSERT_EQ(there, names);
    } else {
      ++interrupted;
      ASSERT_TRUE(there.empty() || there == names) << there.size() << " of the files only";
    }
    for (const std::string& name : there) {
      ASSERT_TRUE(std::find(names.begin(), names.end(), name) != names.end())
          << name << " was left";
      if (name == "r.json") {
        EXPECT_TRUE(read_json(folder / name).contains("timings_s"));
      } else {
        ASSERT_TRUE(read_file(folder / name) == read_file(whole / name)) << name << " is not whole";
      }
    }
  }
  std::printf(
      "%d runs: %d interrupted; the longest took %ld ms\n", runs, interrupted,
      static_cast<long>(std::chrono::duration_cast<std::chrono::milliseconds>(longest).count()));
  EXPECT_GT(interrupted, runs / 3);
  EXPECT_LT(longest, interrupt_limit());
}

/// The first of two files is whole when the signal comes, and still does not take the old one's
/// place.
TEST(Interrupt, BetweenTwoFilesLeavesBothAsTheyWere) {
  bool met = false;
  for (int attempt = 0; attempt < 8 && !met; ++attempt) {
    const Folder folder;
    const Outcome outcome = run_dsc({"surface", "shape:sphere", "--gridstep", "0.006", "--quiet",
                                     "-o", folder / "a.off", "-o", folder / "b.csv"},
                                    {}, [&](int child) {
                                      while (!has_ended(child) && folder.names().size() < 2) {
                                      }
                                      ::kill(child, SIGINT);
                                    });
    met = outcome.exit_code == 130;
    EXPECT_EQ(folder.names(), met ? Words{} : (Words{"a.off", "b.csv"}));
  }
  EXPECT_TRUE(met) << "the second file was written before the signal came";
}

/// A second signal does not wait until the run has ended by itself.
TEST(Interrupt, ASecondSignalWhileAFileIsWrittenLeavesNothing) {
  int tried = 0;
  for (int round = 0; round < 12; ++round) {
    const Folder folder;
    bool writing = false;
    const Outcome outcome = run_dsc(
        {"surface", "shape:sphere", "--gridstep", "0.006", "--quiet", "-o", folder / "r.csv"}, {},
        [&](int child) {
          while (!has_ended(child) && !writing) {
            for (const std::string& name : folder.names()) writing = name != "r.csv";
          }
          std::this_thread::sleep_for(std::chrono::milliseconds(round));
          ::kill(child, SIGINT);
          std::this_thread::sleep_for(std::chrono::microseconds(200));
          ::kill(child, SIGINT);
        });
    if (outcome.exit_code == 0) continue;
    ++tried;
    EXPECT_EQ(outcome.exit_code, 130);
    for (const std::string& name : folder.names()) EXPECT_EQ(name, "r.csv") << "was left";
  }
  EXPECT_GT(tried, 3);
}

/// The process that reads medical images ends with the program.
TEST(Interrupt, EndsTheImageReaderToo) {
  const Folder folder;
  write_file(folder / "v.mha", "ObjectType = Image\n");
  write_file(folder / "reader", "#!/bin/sh\necho $$ > '" + folder / "pid" + "'\nexec sleep 100\n");
  fs::permissions(folder / "reader", fs::perms::owner_all);
  int reader = 0;
  Clock::time_point sent;
  const Outcome outcome = run_dsc(
      {"info", folder / "v.mha"},
      [&] { ::setenv("DSC_IMAGE_READER", (folder / "reader").c_str(), 1); },
      [&](int child) {
        while (!has_ended(child) && reader == 0) {
          std::this_thread::sleep_for(std::chrono::milliseconds(5));
          if (fs::exists(folder / "pid")) reader = std::atoi(read_file(folder / "pid").c_str());
        }
        sent = Clock::now();
        ::kill(child, SIGINT);
      });
  EXPECT_LT(Clock::now() - sent, interrupt_limit());
  EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
  ASSERT_GT(reader, 0);
  // Whoever takes over orphans may leave it as a zombie for a while.
  bool gone = false;
  for (int i = 0; i < 200 && !gone; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    try {
      gone = ::kill(reader, 0) != 0 || has_ended(reader);
    } catch (const std::exception&) {  // its entry in /proc went meanwhile
      gone = true;
    }
  }
  EXPECT_TRUE(gone) << "the reader goes on";
}

}  // namespace
}  // namespace dsc::test
