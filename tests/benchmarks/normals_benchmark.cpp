// Integral invariants: time per ball row (a ball of radius R voxels has pi R^2 rows), one thread.
//
// ns_per_row of the sums alone, by the vector path and the plain scan, and of the whole estimator
// with its eigenvectors. The surface is a sphere of 128 voxels radius: balls of every slope.
#include "libdsc/normals/integral_invariant.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/shapes.h"

#include <benchmark/benchmark.h>

#include <numbers>

namespace dsc {
namespace {

struct Scene {
  BinaryVolume volume = digitize(Sphere(), Vec3::Constant(1. / 128));
  DigitalSurface surface = extract_surface(volume);
};

const Scene& scene() {
  static const Scene s;
  return s;
}

Index3 doubled_centre(const Surfel& s) {
  Index3 c{2 * Index{s.x}, 2 * Index{s.y}, 2 * Index{s.z}};
  c[static_cast<std::size_t>(s.axis())] += s.sign();
  return c;
}

/// Seconds a row, from a rate inverted.
void report(benchmark::State& state, double balls, double radius) {
  const double rows = balls * std::numbers::pi * radius * radius;
  state.counters["s_per_row"] =
      benchmark::Counter(rows * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// Consecutive surfels of one stretch, as the estimator meets them.
std::span<const Surfel> stretch(double radius) {
  const std::span<const Surfel> all = scene().surface.surfels();
  const auto n = std::min(all.size(), static_cast<std::size_t>(4e6 / (radius * radius)));
  return all.subspan(all.size() / 3, std::min(n, all.size() / 3));
}

template <bool kPlain>
void moments(benchmark::State& state) {
  const auto radius = static_cast<double>(state.range(0));
  const BallScanner scan(scene().volume, radius / 128, BallScanner::Centres::surfels);
  const std::span<const Surfel> surfels = stretch(radius);
  for (auto _ : state) {
    for (const Surfel& s : surfels) {
      const Index3 centre = doubled_centre(s);
      benchmark::DoNotOptimize(kPlain ? scan.plain(centre) : scan(centre));
    }
  }
  report(state, static_cast<double>(surfels.size()), radius);
}

void normals(benchmark::State& state) {
  const auto radius = static_cast<double>(state.range(0));
  const std::span<const Surfel> surfels = stretch(radius);
  const auto centre = state.range(1) == 0 ? BallCentre::surfel : BallCentre::voxel_pair;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        integral_invariant_normals(scene().volume, surfels, {radius / 128, centre}, {1, nullptr}));
  }
  report(state, static_cast<double>(surfels.size()) * (state.range(1) == 0 ? 1 : 2), radius);
}

BENCHMARK(moments<false>)->Name("moments/vector")->Arg(3)->Arg(6)->Arg(12)->Arg(24);
BENCHMARK(moments<true>)->Name("moments/plain")->Arg(3)->Arg(6)->Arg(12)->Arg(24);
BENCHMARK(normals)->ArgNames({"R", "pair"})->ArgsProduct({{3, 6, 12, 24}, {0, 1}});

}  // namespace
}  // namespace dsc
