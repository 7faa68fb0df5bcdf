/// \file
/// Time and memory of one stage.
///
/// The first run in a process is the cold one: it touches its memory for the first time, and gives
/// the peak. Then freed memory is kept, as a program that goes on working does, and the stage runs
/// again: the median of those runs is the time. The cold figures are true in a process that runs
/// one benchmark; the report starts one for each.
#pragma once

#include <benchmark/benchmark.h>

#include <chrono>
#include <optional>
#include <utility>
#include <vector>

namespace dsc::benchmarks {

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Gives unused memory back to the system, forgets the peak, returns the resident bytes.
double settle_memory();
double resident_bytes();
/// The most that was resident since settle_memory().
double peak_bytes();
/// From here on what is freed stays with the process.
void keep_freed_memory();

struct Cost {
  double cold = 0;  ///< seconds
  double warm = 0;
  double peak = 0;  ///< bytes beyond those resident before
  double kept = 0;  ///< bytes of the result
};

/// A run longer than this is not repeated: the cold one counts.
inline constexpr double kLongRun = 4.;
/// Repeats go on until they have taken this long.
inline constexpr double kRepeatFor = 1.;

double median(std::vector<double> values);

/// Counters: `faces`, `cold`, `peak`, `resident` (the process at its peak). `stage` returns what it
/// makes; `result` receives the last one.
template <class Stage, class Result>
Cost measure(benchmark::State& state, double faces, Stage&& stage, std::optional<Result>& result) {
  Cost cost;
  const double before = settle_memory();
  const Stopwatch cold;
  result.emplace(stage());
  cost.cold = cold.seconds();
  const double peak = peak_bytes();
  cost.peak = peak - before;
  cost.kept = settle_memory() - before;
  keep_freed_memory();

  std::vector<double> runs;
  const Stopwatch all;
  while (cost.cold < kLongRun &&
         (runs.empty() || (all.seconds() < kRepeatFor && runs.size() < 50))) {
    result.reset();
    const Stopwatch warm;
    result.emplace(stage());
    runs.push_back(warm.seconds());
  }
  cost.warm = runs.empty() ? cost.cold : median(runs);
  for (auto _ : state) state.SetIterationTime(cost.warm);
  state.counters["faces"] = faces;
  state.counters["cold"] = cost.cold;
  state.counters["peak"] = cost.peak;
  state.counters["resident"] = peak;
  return cost;
}

/// The least that the stage has to do, in units of a ceiling of ceilings_benchmark.cpp.
void note_floor(benchmark::State& state, double work, const char* ceiling);

inline constexpr const char* kMemory = "memory";      ///< bytes streamed, all threads
inline constexpr const char* kShuffles = "shuffles";  ///< byte shuffles of 32 bytes, one thread
inline constexpr const char* kFma = "fma";            ///< multiply-adds of doubles, one thread

}  // namespace dsc::benchmarks
