#include "tests/benchmarks/scene.h"

#include "libdsc/io/read_binary.h"
#include "libdsc/normals/surface_normals.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/shapes.h"

#include <cstdlib>
#include <filesystem>
#include <memory>

namespace dsc::benchmarks {
namespace {

Scene make(int n) {
  if (n == kSpot) {
    BinaryVolume volume = read_binary(spot_path());
    DigitalSurface surface = extract_surface(volume);
    const double h = volume.grid().spacing[0];
    integral_invariant_normals(surface, volume, {.radius = 6. * h});
    return {n, h, std::move(volume), std::move(surface)};
  }
  const double h = 1. / n;
  BinaryVolume volume = digitize(Sphere(), Vec3::Constant(h));
  DigitalSurface surface = extract_surface(volume);
  analytic_normals(surface, Sphere());
  return {n, h, std::move(volume), std::move(surface)};
}

}  // namespace

const Scene& scene(int n) {
  static std::unique_ptr<const Scene> kept;
  if (!kept || kept->n != n) {
    kept.reset();  // before the next: memory
    kept = std::make_unique<const Scene>(make(n));
  }
  return *kept;
}

std::string spot_path() {
  const char* folder = std::getenv("DSC_TEST_DATA");
  const std::string path = std::string(folder != nullptr ? folder : ".") + "/spot-512.vol";
  return std::filesystem::exists(path) ? path : std::string();
}

benchmark::internal::Benchmark* at_sizes(const char* name, void (*stage)(benchmark::State&),
                                         int largest) {
  auto* family = benchmark::RegisterBenchmark(name, stage)->ArgName("n");
  for (const int n : kSizes) {
    if (n <= largest) family->Arg(n);
  }
  return family->Iterations(1)->UseManualTime()->Unit(benchmark::kMillisecond);
}

void at_sizes_and_spot(const char* name, void (*stage)(benchmark::State&), int largest) {
  auto* family = at_sizes(name, stage, largest);
  if (!spot_path().empty()) family->Arg(kSpot);
}

void note_errors(benchmark::State& state, const Eigen::VectorXd& errors) {
  state.counters["error_mean"] = errors.cwiseAbs().mean();
  state.counters["error_max"] = errors.cwiseAbs().maxCoeff();
}

}  // namespace dsc::benchmarks
