// What this machine can do at most: the ceilings that the stages are compared with. The best of
// some runs each; the counter `rate` is per second.
#include "tests/benchmarks/measure.h"

#include <benchmark/benchmark.h>
#include <sys/mman.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#define DSC_BENCHMARK_X86
#endif

namespace dsc::benchmarks {
namespace {

/// part(i) on `threads` threads.
void on_threads(int threads, const std::function<void(int)>& part) {
  std::vector<std::thread> others;
  for (int i = 1; i < threads; ++i) others.emplace_back(part, i);
  part(0);
  for (std::thread& t : others) t.join();
}

void note_rate(benchmark::State& state, double work, int runs, const std::function<double()>& run) {
  double best = run();
  for (int i = 1; i < runs; ++i) best = std::min(best, run());
  for (auto _ : state) state.SetIterationTime(best);
  state.counters["rate"] = work / best;
}

/// a = b + s c on arrays far beyond the caches; 24 bytes an element, as STREAM counts.
void triad(benchmark::State& state) {
  const auto threads = static_cast<int>(state.range(0));
  constexpr std::size_t kPart = std::size_t{1} << 23;
  const std::size_t n = kPart * static_cast<std::size_t>(threads);
  std::vector<double> a(n), b(n, 1.), c(n, 2.);
  const auto part = [&](int i) {
    const std::size_t first = kPart * static_cast<std::size_t>(i);
    double* to = a.data() + first;
    const double* x = b.data() + first;
    const double* y = c.data() + first;
    for (std::size_t k = 0; k < kPart; ++k) to[k] = x[k] + 3. * y[k];
    benchmark::ClobberMemory();
  };
  note_rate(state, 24. * static_cast<double>(n), 12, [&] {
    const Stopwatch watch;
    on_threads(threads, part);
    return watch.seconds();
  });
}

/// Bytes of fresh pages that the system hands out, each touched once. The median: no two runs get
/// the same pages.
void first_touch(benchmark::State& state) {
  const auto threads = static_cast<int>(state.range(0));
  constexpr std::size_t kBytes = std::size_t{1} << 29;
  std::vector<double> runs;
  for (int i = 0; i < 5; ++i) {
    void* memory =
        mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) return state.SkipWithError("no memory");
    auto* bytes = static_cast<volatile char*>(memory);
    const std::size_t part = kBytes / static_cast<std::size_t>(threads);
    const Stopwatch watch;
    on_threads(threads, [&](int t) {
      const std::size_t first = part * static_cast<std::size_t>(t);
      for (std::size_t k = first; k < first + part; k += 4096) bytes[k] = 1;
    });
    runs.push_back(watch.seconds());
    munmap(memory, kBytes);
  }
  const double usual = median(runs);
  for (auto _ : state) state.SetIterationTime(usual);
  state.counters["rate"] = static_cast<double>(kBytes) / usual;
}

/// The yardstick that figures of other machines are scaled by: Eigen's LDLT in its default order of
/// I - graph Laplacian, weights 1/3, on the 9-point 400 × 400 grid.
void yardstick(benchmark::State& state) {
  constexpr int kSide = 400;
  std::vector<Eigen::Triplet<double>> entries;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      double diagonal = 1.;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const bool inside = x + dx >= 0 && x + dx < kSide && y + dy >= 0 && y + dy < kSide;
          if (!inside || (dx == 0 && dy == 0)) continue;
          entries.emplace_back(kSide * y + x, kSide * (y + dy) + x + dx, -1. / 3);
          diagonal += 1. / 3;
        }
      }
      entries.emplace_back(kSide * y + x, kSide * y + x, diagonal);
    }
  }
  Eigen::SparseMatrix<double> matrix(kSide * kSide, kSide * kSide);
  matrix.setFromTriplets(entries.begin(), entries.end());
  note_rate(state, 1., 3, [&] {
    const Stopwatch watch;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldlt(matrix);
    return ldlt.info() == Eigen::Success ? watch.seconds() : 1e9;
  });
}

#ifdef DSC_BENCHMARK_X86

/// Words counted, from the nearest cache.
__attribute__((target("popcnt"))) double popcount_seconds(int times) {
  const std::vector<std::uint64_t> words(1024, 0x123456789abcdef0);
  std::int64_t a = 0, b = 0, c = 0, d = 0;
  const Stopwatch watch;
  for (int i = 0; i < times; ++i) {
    for (std::size_t k = 0; k < words.size(); k += 4) {
      a += __builtin_popcountll(words[k]);
      b += __builtin_popcountll(words[k + 1]);
      c += __builtin_popcountll(words[k + 2]);
      d += __builtin_popcountll(words[k + 3]);
    }
    asm volatile("" : "+r"(a), "+r"(b), "+r"(c), "+r"(d));
  }
  return watch.seconds();
}

void popcount(benchmark::State& state) {
  if (__builtin_cpu_supports("popcnt") == 0) return state.SkipWithError("no popcnt");
  constexpr int kTimes = 20'000;
  note_rate(state, 1024. * kTimes, 7, [] { return popcount_seconds(kTimes); });
}

/// Byte shuffles of 32 bytes, from register to register.
__attribute__((target("avx2"))) double shuffle_seconds(int times) {
  const __m256i table = _mm256_set1_epi8(7);
  __m256i a = table, b = table, c = table, d = table, e = table, f = table;
  const Stopwatch watch;
  for (int i = 0; i < times; ++i) {
    a = _mm256_shuffle_epi8(table, a);
    b = _mm256_shuffle_epi8(table, b);
    c = _mm256_shuffle_epi8(table, c);
    d = _mm256_shuffle_epi8(table, d);
    e = _mm256_shuffle_epi8(table, e);
    f = _mm256_shuffle_epi8(table, f);
    asm volatile("" : "+x"(a), "+x"(b), "+x"(c), "+x"(d), "+x"(e), "+x"(f));
  }
  return watch.seconds();
}

void shuffles(benchmark::State& state) {
  if (__builtin_cpu_supports("avx2") == 0) return state.SkipWithError("no AVX2");
  constexpr int kTimes = 20'000'000;
  note_rate(state, 6. * kTimes, 5, [] { return shuffle_seconds(kTimes); });
}

/// Multiply-adds of doubles, four a register.
__attribute__((target("avx2,fma"))) double fma_seconds(int times) {
  __m256d v[10];
  for (__m256d& x : v) x = _mm256_set1_pd(1.);
  const __m256d factor = _mm256_set1_pd(0.999);
  const __m256d addend = _mm256_set1_pd(0.001);
  const Stopwatch watch;
  for (int i = 0; i < times; ++i) {
    for (__m256d& x : v) {
      x = _mm256_fmadd_pd(x, factor, addend);
      asm volatile("" : "+x"(x));
    }
  }
  return watch.seconds();
}

void fma(benchmark::State& state) {
  if (__builtin_cpu_supports("fma") == 0) return state.SkipWithError("no FMA");
  constexpr int kTimes = 20'000'000;
  note_rate(state, 40. * kTimes, 5, [] { return fma_seconds(kTimes); });
}

#else

void popcount(benchmark::State& state) { state.SkipWithError("x86-64 only"); }
void shuffles(benchmark::State& state) { state.SkipWithError("x86-64 only"); }
void fma(benchmark::State& state) { state.SkipWithError("x86-64 only"); }

#endif

benchmark::internal::Benchmark* ceiling(const char* name, void (*run)(benchmark::State&)) {
  return benchmark::RegisterBenchmark(name, run)->Iterations(1)->UseManualTime()->Unit(
      benchmark::kMillisecond);
}

const bool registered = [] {
  ceiling("ceiling/triad", triad)->ArgName("threads")->Arg(1)->Arg(2);
  ceiling("ceiling/first_touch", first_touch)->ArgName("threads")->Arg(1)->Arg(2);
  ceiling("ceiling/popcount", popcount);
  ceiling("ceiling/shuffles", shuffles);
  ceiling("ceiling/fma", fma);
  ceiling("ceiling/yardstick", yardstick);
  return true;
}();

}  // namespace
}  // namespace dsc::benchmarks
