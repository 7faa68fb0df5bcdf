// Integral invariant normals: time per ball row (a ball of radius R voxels has π R² rows) and core.
//
// Floor: the count, Σx and Σx² of a row by nibble tables take six byte shuffles of 32 bytes for
// four rows. Bricks (brick_ball.h), which serve balls of more than 200 rows on large surfaces, do
// not look at every row, and may come below it.
#include "libdsc/base/parallel.h"
#include "libdsc/normals/integral_invariant.h"
#include "tests/benchmarks/measure.h"
#include "tests/benchmarks/scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace dsc::benchmarks {
namespace {

constexpr int kSumsSize = 193;  // balls of every slope, on a surface beyond the caches
constexpr double kShufflesPerRow = 1.5;

double ball_rows(double radius) { return std::numbers::pi * radius * radius; }

Index3 doubled_centre(const Surfel& s) {
  Index3 c{2 * Index{s.x}, 2 * Index{s.y}, 2 * Index{s.z}};
  c[static_cast<std::size_t>(s.axis())] += s.sign();
  return c;
}

/// About `wanted` surfels of every part of the surface, in the order in which an estimator meets
/// them.
std::vector<Surfel> stretches(std::span<const Surfel> all, std::size_t wanted) {
  constexpr std::size_t kParts = 16;
  std::vector<Surfel> some;
  for (std::size_t part = 0; part < kParts; ++part) {
    const std::size_t begin = all.size() * part / kParts;
    const std::size_t end = std::min(begin + wanted / kParts, all.size() * (part + 1) / kParts);
    some.insert(some.end(), all.begin() + static_cast<std::ptrdiff_t>(begin),
                all.begin() + static_cast<std::ptrdiff_t>(end));
  }
  return some;
}

/// The sums alone, as the estimator takes them, on one thread.
void sums(benchmark::State& state) {
  const auto radius = static_cast<double>(state.range(0));
  const Scene& s = scene(kSumsSize);
  const std::span<const Surfel> surfels = s.surface.surfels();
  const IntegralInvariantOptions options{radius * s.h};
  std::optional<Index> total;
  const Cost cost = measure(
      state, s.faces(),
      [&] {
        Index count = 0;
        visit_balls(s.volume, surfels, options,
                    [&](Index, std::span<const BallMoments> balls) { count += balls[0].count; },
                    {1, nullptr});
        return count;
      },
      total);
  const double rows = s.faces() * ball_rows(radius);
  state.counters["ns_per_row"] = 1e9 * cost.warm / rows;
  note_floor(state, kShufflesPerRow * rows, kShuffles);

  // Balls unlike the plain scan, of about 2 000 all over the surface.
  const BallScanner scan(s.volume, options.radius, BallScanner::Centres::surfels);
  const Index step = static_cast<Index>(surfels.size()) / 2000;
  double wrong = 0;
  visit_balls(s.volume, surfels, options,
              [&](Index i, std::span<const BallMoments> balls) {
                if (i % step != 0) return;
                const Surfel& surfel = surfels[static_cast<std::size_t>(i)];
                wrong += balls[0] == scan.plain(doubled_centre(surfel)) ? 0 : 1;
              },
              {1, nullptr});
  state.counters["wrong_balls"] = wrong;
}

/// The same by the rows of every ball, which serves small balls and small surfaces, and by the
/// plain scan, which every path is tested against.
template <bool kPlain>
void row_sums(benchmark::State& state) {
  const auto radius = static_cast<double>(state.range(0));
  const Scene& s = scene(kSumsSize);
  const BallScanner scan(s.volume, radius * s.h, BallScanner::Centres::surfels);
  const std::vector<Surfel> surfels = stretches(
      s.surface.surfels(), static_cast<std::size_t>((kPlain ? 1e7 : 5e7) / ball_rows(radius)));
  const double rows = static_cast<double>(surfels.size()) * ball_rows(radius);
  std::optional<Index> total;
  const Cost cost = measure(
      state, static_cast<double>(surfels.size()),
      [&] {
        Index count = 0;
        for (const Surfel& surfel : surfels) {
          const Index3 centre = doubled_centre(surfel);
          count += (kPlain ? scan.plain(centre) : scan(centre)).count;
        }
        return count;
      },
      total);
  state.counters["ns_per_row"] = 1e9 * cost.warm / rows;
  note_floor(state, kShufflesPerRow * rows, kShuffles);
}

/// The whole estimator, eigenvectors included, on all cores. Error: degrees, against the sphere's.
void normals(benchmark::State& state) {
  const auto radius = static_cast<double>(state.range(0));
  const Scene& s = scene(static_cast<int>(state.range(1)));
  const auto threads = static_cast<int>(state.range(2));
  const Context context{threads, nullptr};
  std::optional<NormalField> field;
  const Cost cost = measure(
      state, s.faces(),
      [&] {
        return integral_invariant_normals(s.volume, s.surface.surfels(), {radius * s.h}, context);
      },
      field);
  const double rows = s.faces() * ball_rows(radius);
  const double cores = thread_count(context);
  state.counters["ns_per_row"] = 1e9 * cost.warm * cores / rows;
  Eigen::VectorXd degrees(field->u.cols());
  for (Index f = 0; f < degrees.size(); ++f) {
    const Vec3 truth =
        s.surface.surfels()[static_cast<std::size_t>(f)].centre(s.volume.grid()).normalized();
    const Vec3 u = field->u.col(f);
    degrees[f] = std::atan2(u.cross(truth).norm(), u.dot(truth)) * 180. / std::numbers::pi;
  }
  note_errors(state, degrees);
  note_floor(state, kShufflesPerRow * rows / cores, kShuffles);
}

benchmark::internal::Benchmark* by_hand(benchmark::internal::Benchmark* family) {
  return family->Iterations(1)->UseManualTime()->Unit(benchmark::kMillisecond);
}

const bool registered = [] {
  for (const int radius : {3, 6, 12, 24}) {
    by_hand(benchmark::RegisterBenchmark("sums", sums)->ArgName("R"))->Arg(radius);
    by_hand(benchmark::RegisterBenchmark("sums_by_rows", row_sums<false>)->ArgName("R"))
        ->Arg(radius);
    by_hand(benchmark::RegisterBenchmark("sums_plain", row_sums<true>)->ArgName("R"))->Arg(radius);
    auto* all = by_hand(benchmark::RegisterBenchmark("normals", normals));
    all->ArgNames({"R", "n", "threads"});
    for (const int n : kSizes) all->Args({radius, n, 0});
    all->Args({radius, kSumsSize, 1});
  }
  by_hand(benchmark::RegisterBenchmark("sums", sums)->ArgName("R"))->Arg(52);
  by_hand(benchmark::RegisterBenchmark("sums_by_rows", row_sums<false>)->ArgName("R"))->Arg(52);
  return true;
}();

}  // namespace
}  // namespace dsc::benchmarks
