/// \file
/// Volumes for tests.
#pragma once

#include "libdsc/voxels/binary_volume.h"

#include <random>

namespace dsc::testing {

/// Each voxel is inside with the given probability.
inline BinaryVolume random_volume(Index3 size, double density, unsigned seed,
                                  const Vec3& spacing = {1, 1, 1}) {
  BinaryVolume volume(Grid{size, spacing, Vec3::Zero()});
  std::mt19937 generator(seed);
  std::bernoulli_distribution inside(density);
  for (Index z = 0; z < size[2]; ++z) {
    for (Index y = 0; y < size[1]; ++y) {
      for (Index x = 0; x < size[0]; ++x) {
        if (inside(generator)) volume.set(x, y, z);
      }
    }
  }
  return volume;
}

/// A solid box of voxels [lo, hi) in a grid of the given size.
inline BinaryVolume box_volume(Index3 size, Index3 lo, Index3 hi) {
  BinaryVolume volume(Grid{size, {1, 1, 1}, Vec3::Zero()});
  for (Index z = lo[2]; z < hi[2]; ++z) {
    for (Index y = lo[1]; y < hi[1]; ++y) {
      for (Index x = lo[0]; x < hi[0]; ++x) volume.set(x, y, z);
    }
  }
  return volume;
}

}  // namespace dsc::testing
