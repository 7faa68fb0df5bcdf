/// \file
/// The surfaces that the benchmarks run on.
#pragma once

#include "libdsc/surface/digital_surface.h"
#include "libdsc/voxels/binary_volume.h"

#include <benchmark/benchmark.h>

#include <span>
#include <string>

namespace dsc::benchmarks {

/// Voxels to the radius of the unit sphere: about 6 π n² faces, 0.01 to 5 million.
inline constexpr int kSizes[] = {23, 73, 193, 303, 515};
/// In the place of n: the voxels of spot-512.vol, in the folder DSC_TEST_DATA.
inline constexpr int kSpot = 0;

struct Scene {
  int n;
  double h;
  BinaryVolume volume;
  DigitalSurface surface;  ///< with the sphere's own normals; spot: integral invariants, R = 6

  double faces() const { return static_cast<double>(surface.face_count()); }
  double vertices() const { return static_cast<double>(surface.vertex_count()); }
};

/// The scene of size n; kept until another is asked for.
const Scene& scene(int n);

/// The path of spot-512.vol, empty where it is not there.
std::string spot_path();

/// `stage` at the sizes up to `largest`, timed by hand (measure.h).
benchmark::internal::Benchmark* at_sizes(const char* name, void (*stage)(benchmark::State&),
                                         int largest);
/// The same, and spot where it is there.
void at_sizes_and_spot(const char* name, void (*stage)(benchmark::State&), int largest);

/// Adds the counters error_mean and error_max.
void note_errors(benchmark::State& state, const Eigen::VectorXd& errors);

}  // namespace dsc::benchmarks
