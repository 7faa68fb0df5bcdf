// Voxels: reading, digitization, and the scan of a volume that is nearly empty.
#include "libdsc/io/read_binary.h"
#include "libdsc/io/volume_writer.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/shapes.h"
#include "tests/benchmarks/measure.h"
#include "tests/benchmarks/scene.h"

#include <unistd.h>

#include <filesystem>

namespace dsc::benchmarks {
namespace {

double faces_of(const BinaryVolume& volume) {
  return static_cast<double>(extract_surface(volume).face_count());
}

/// Floor: the values of the file, a byte each, and the bits made of them, once through memory.
void read(benchmark::State& state) {
  const auto n = static_cast<int>(state.range(0));
  std::string path = spot_path();
  double faces = 0;
  if (n != kSpot) {
    const BinaryVolume volume = digitize(Sphere(), Vec3::Constant(1. / n));
    path = (std::filesystem::temp_directory_path() /
            ("dsc-benchmark-" + std::to_string(getpid()) + ".vol"))
               .string();
    write_volume(path, volume);
    faces = faces_of(volume);
  } else {
    faces = faces_of(read_binary(path));
  }
  std::optional<BinaryVolume> volume;
  measure(
      state, faces, [&] { return read_binary(path); }, volume);
  if (n != kSpot) std::filesystem::remove(path);
  const Index3& size = volume->grid().size;
  const double voxels =
      static_cast<double>(size[0]) * static_cast<double>(size[1]) * static_cast<double>(size[2]);
  note_floor(state, voxels + static_cast<double>(volume->memory_bytes()), kMemory);
}

/// Floor: the bits, written once.
void digitize_sphere(benchmark::State& state) {
  const auto n = static_cast<int>(state.range(0));
  const double faces = faces_of(digitize(Sphere(), Vec3::Constant(1. / n)));
  std::optional<BinaryVolume> volume;
  measure(
      state, faces, [&] { return digitize(Sphere(), Vec3::Constant(1. / n)); }, volume);
  note_floor(state, static_cast<double>(volume->memory_bytes()), kMemory);
}

/// A ball of 8 voxels radius in 1024³. Floor: the bits, read once.
void scan(benchmark::State& state) {
  Grid grid;
  grid.size = {1024, 1024, 1024};
  BinaryVolume volume(grid);
  for (Index z = -8; z <= 8; ++z) {
    for (Index y = -8; y <= 8; ++y) {
      for (Index x = -8; x <= 8; ++x) {
        if (x * x + y * y + z * z <= 64) volume.set(700 + x, 500 + y, 300 + z);
      }
    }
  }
  std::optional<DigitalSurface> surface;
  const double faces = faces_of(volume);
  const Cost cost = measure(
      state, faces, [&] { return extract_surface(volume); }, surface);
  state.counters["bytes_per_second"] = static_cast<double>(volume.memory_bytes()) / cost.warm;
  note_floor(state, static_cast<double>(volume.memory_bytes()), kMemory);
}

const bool registered = [] {
  at_sizes_and_spot("read", read, 515);
  at_sizes("digitize", digitize_sphere, 515);
  benchmark::RegisterBenchmark("scan", scan)
      ->Iterations(1)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
}  // namespace dsc::benchmarks
