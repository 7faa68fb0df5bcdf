/// \file
/// Volumes and surfels for the tests of normals, made by the plainest means.
#pragma once

#include "libdsc/normals/surface_normals.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/surface/surfel.h"
#include "libdsc/voxels/binary_volume.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace dsc::test {

/// Every voxel whose centre satisfies `inside`.
template <class Inside>
BinaryVolume fill(const Grid& grid, Inside inside) {
  BinaryVolume volume(grid);
  for (Index z = 0; z < grid.size[2]; ++z) {
    for (Index y = 0; y < grid.size[1]; ++y) {
      for (Index x = 0; x < grid.size[0]; ++x) {
        const Vec3 p =
            grid.position(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
        if (inside(p)) volume.set(x, y, z);
      }
    }
  }
  return volume;
}

/// The open ball of that radius around the origin, with a margin.
inline BinaryVolume digital_sphere(double radius, double h) {
  const Index n = static_cast<Index>(std::ceil(radius / h)) + 1;
  Grid grid;
  grid.size = {2 * n + 1, 2 * n + 1, 2 * n + 1};
  grid.spacing = Vec3::Constant(h);
  grid.origin = Vec3::Constant(-h * static_cast<double>(n));
  return fill(grid, [&](const Vec3& p) { return p.norm() < radius; });
}

inline BinaryVolume random_volume(const Grid& grid, double density, unsigned seed) {
  std::mt19937 random(seed);
  std::bernoulli_distribution coin(density);
  return fill(grid, [&](const Vec3&) { return coin(random); });
}

/// All surfels, by looking at every pair of neighbours.
inline std::vector<Surfel> all_surfels(const BinaryVolume& volume) {
  std::vector<Surfel> surfels;
  const Index3& size = volume.grid().size;
  for (Index z = 0; z < size[2]; ++z) {
    for (Index y = 0; y < size[1]; ++y) {
      for (Index x = 0; x < size[0]; ++x) {
        if (!volume(x, y, z)) continue;
        for (int direction = 0; direction < 6; ++direction) {
          Index3 q{x, y, z};
          q[static_cast<std::size_t>(direction / 2)] += direction % 2 == 0 ? -1 : 1;
          if (volume(q[0], q[1], q[2])) continue;
          surfels.push_back({static_cast<std::int32_t>(x), static_cast<std::int32_t>(y),
                             static_cast<std::int32_t>(z), direction});
        }
      }
    }
  }
  return surfels;
}

/// Angles in degrees.
struct Angles {
  double worst = 0, mean = 0;
};

/// Between n and the normals of the surface of a volume that a plane of normal n cuts in two, the
/// plane going on, or not, beyond the open border.
template <class Volume>
Angles angles_at_open_border(const Volume& volume, const Vec3& n, Beyond beyond) {
  ExtractOptions open;
  open.border = Border::open;
  DigitalSurface surface = extract_surface(volume, open);
  const NormalReport report = integral_invariant_normals(
      surface, volume, {.radius = 6, .centre = BallCentre::surfel, .beyond = beyond});
  EXPECT_EQ(report.cut_faces > 0, beyond == Beyond::continued);
  Angles angles;
  for (Index f = 0; f < surface.face_count(); ++f) {
    const double angle = std::acos(std::min(1., surface.normals()[f].dot(n))) * 180 / M_PI;
    angles.worst = std::max(angles.worst, angle);
    angles.mean += angle / static_cast<double>(surface.face_count());
  }
  return angles;
}

/// Where balls go on beyond the border the normals stay near the truth. \return their angles, and
/// those where balls end there.
template <class Volume>
std::array<Angles, 2> expect_near_truth_at_open_border(const Volume& volume, const Vec3& n) {
  const Angles whole = angles_at_open_border(volume, n, Beyond::continued);
  EXPECT_LT(whole.mean, 2.);  // degrees; about one far from the border
  EXPECT_LT(whole.worst, 25.);
  return {whole, angles_at_open_border(volume, n, Beyond::empty)};
}

}  // namespace dsc::test
