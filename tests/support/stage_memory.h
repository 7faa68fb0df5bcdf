/// \file
/// What stages ask for and what they take, measured in a process of its own, whose peak is reset
/// where a stage asks.
#pragma once

#include "libdsc/io/memory_limit.h"
#include "tests/io/temporary_folder.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace dsc::testing {

/// By name, what runs stages.
using StageRuns = std::map<std::string, std::function<void(const Context&)>>;

/// The highest resident size since the last reset, in bytes.
inline Index peak_bytes() {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("VmHWM:", 0) == 0) return std::stoll(line.substr(6)) * 1024;
  }
  throw std::runtime_error("no VmHWM in /proc/self/status");
}

inline void reset_peak() { write_all("/proc/self/clear_refs", "5"); }

/// Notes what every stage asks for and what the process then takes until the next one asks.
class StageRecorder final : public MemoryLimit {
 public:
  struct Stage {
    std::string name;
    Index asked = 0, taken = 0;
  };

  void need(std::string_view stage, Index bytes) const override {
    if (!stages_.empty()) stages_.back().taken = peak_bytes() - held_;
    if (!stages_.empty() && stages_.back().name == stage) {  // a part of the same
      stages_.back().asked += bytes;
      return;
    }
    (void)::malloc_trim(0);  // what was freed must not serve again unseen
    reset_peak();
    held_ = resident_bytes();
    stages_.push_back({std::string(stage), bytes, 0});
  }
  Index left() const override { return Index{1} << 40; }

  const std::vector<Stage>& finish() {
    need("end", 0);
    stages_.pop_back();
    return stages_;
  }

 private:
  mutable std::vector<Stage> stages_;
  mutable Index held_ = 0;
};

/// The process of its own; called by a disabled test, which expect_stages_within() starts.
inline void record_stages(const StageRuns& runs) {
  const char* run = std::getenv("DSC_STAGE_RUN");
  ASSERT_NE(run, nullptr);
  StageRecorder recorder;
  runs.at(run)({1, nullptr, &recorder});
  std::ofstream out(std::getenv("DSC_STAGE_OUTPUT"));
  for (const auto& stage : recorder.finish()) {
    out << stage.asked << ' ' << stage.taken << ' ' << stage.name << '\n';
  }
}

/// Expects that each stage of each run takes at most what it asks for and at least a third of it.
/// `program` is this one, and `child` its disabled test.
/// \return the stages that took enough to tell.
inline std::set<std::string> expect_stages_within(const StageRuns& runs, const std::string& program,
                                                  const std::string& child) {
  constexpr Index kSlack = Index{3} << 20;  // what allocators and the system take in pages
  const TemporaryFolder folder;
  std::set<std::string> compared;
  for (const auto& [name, run] : runs) {
    const std::string output = folder / name;
    const std::string command = "DSC_STAGE_RUN=" + name + " DSC_STAGE_OUTPUT='" + output + "' '" +
                                program +
                                "' --gtest_also_run_disabled_tests --gtest_filter=" + child +
                                " > '" + folder / "log" + "' 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << name << "\n" << read_all(folder / "log");
    std::istringstream lines(read_all(output));
    Index asked = 0, taken = 0;
    std::string stage;
    while (lines >> asked >> taken && std::getline(lines >> std::ws, stage)) {
      if (stage == "between") continue;
      SCOPED_TRACE(name + ": " + stage + ", asked " + bytes_text(asked) + ", taken " +
                   bytes_text(taken));
      if (std::getenv("DSC_STAGE_PRINT") != nullptr) {
        std::printf("%-14s %-20s asked %10s taken %10s  %.2f\n", name.c_str(), stage.c_str(),
                    bytes_text(asked).c_str(), bytes_text(taken).c_str(),
                    static_cast<double>(taken) / static_cast<double>(asked));
      }
      EXPECT_LE(taken, asked + kSlack);
      if (asked < 2 * kSlack) continue;
      EXPECT_GE(3 * taken, asked);
      compared.insert(stage);
    }
  }
  return compared;
}

}  // namespace dsc::testing
