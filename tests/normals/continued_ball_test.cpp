#include "libdsc/normals/continued_ball.h"

#include "libdsc/normals/surface_normals.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "tests/normals/normals_support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dsc {
namespace {

/// The voxels p of a box of the lattice with n.(2p - centre) < 0; `low` is the first one.
BinaryVolume half_space(const Vec3& n, const Index3& centre, const Index3& low,
                        const Index3& size) {
  BinaryVolume volume(Grid{size});
  for (Index z = 0; z < size[2]; ++z) {
    for (Index y = 0; y < size[1]; ++y) {
      for (Index x = 0; x < size[0]; ++x) {
        const Index3 p{low[0] + x, low[1] + y, low[2] + z};
        double side = 0;
        for (std::size_t a = 0; a < 3; ++a) {
          side += n[static_cast<int>(a)] * static_cast<double>(2 * p[a] - centre[a]);
        }
        volume.set(x, y, z, side < 0);
      }
    }
  }
  return volume;
}

TEST(ContinuedBall, OfAPlaneThroughItsCentreIsTheWholeBall) {
  // No lattice point lies on a plane of this slope, so the mirror images are what they stand for.
  std::mt19937 random(3);
  std::normal_distribution<double> slope;
  std::uniform_int_distribution<Index> cut(0, 7);
  for (int i = 0; i < 60; ++i) {
    const int axis = i % 3;
    Index3 centre{40, 40, 40};
    centre[static_cast<std::size_t>(axis)] += 1;
    const Vec3 n(slope(random), slope(random), slope(random));
    const BinaryVolume whole = half_space(n, centre, {0, 0, 0}, {41, 41, 41});
    // Cut on one side of one axis: every mirror image stays within.
    Index3 low{0, 0, 0};
    low[static_cast<std::size_t>(i / 3 % 3)] = 12 + cut(random);
    const BinaryVolume part = half_space(n, centre, low, {41 - low[0], 41 - low[1], 41 - low[2]});
    const Index3 there{centre[0] - 2 * low[0], centre[1] - 2 * low[1], centre[2] - 2 * low[2]};
    for (const double radius : {3., 6.5, 9.}) {
      const BallScanner scan(whole, radius, BallScanner::Centres::surfels);
      const BallScanner cut_scan(part, radius, BallScanner::Centres::surfels);
      bool beyond = false;
      ASSERT_EQ(cut_scan.continued(there, beyond), scan(centre)) << i << " " << radius;
      const double room = static_cast<double>(
          std::min({there[0], there[1], there[2]}));  // doubled, to the first voxels
      if (room >= 2 * radius) {
        EXPECT_FALSE(beyond) << i << " " << radius;
      }
      if (room < 2 * radius - 2) {
        EXPECT_TRUE(beyond) << i << " " << radius;
      }
    }
  }
}

TEST(ContinuedBall, IsTheBallWhereItFits) {
  const BinaryVolume volume = test::random_volume({{30, 31, 32}}, 0.5, 8);
  const BallScanner scan(volume, 5, BallScanner::Centres::voxels);
  for (const Index3& centre : {Index3{30, 30, 30}, Index3{10, 50, 14}}) {
    bool beyond = true;
    EXPECT_EQ(scan.continued(centre, beyond), scan(centre));
    EXPECT_FALSE(beyond);
  }
}

TEST(ContinuedBall, FullAndEmptyVolumesHaveNoPreference) {
  // Where the whole neighbourhood is set, mirror images are empty: nothing is made up.
  BinaryVolume volume(Grid{{20, 20, 20}});
  const BallScanner empty(volume, 6, BallScanner::Centres::voxels);
  bool beyond = false;
  const Index seen = [&] {
    BinaryVolume full(Grid{{20, 20, 20}});
    for (Index i = 0; i < 8000; ++i) full.set(i % 20, i / 20 % 20, i / 400);
    return BallScanner(full, 6, BallScanner::Centres::voxels)({0, 20, 20}).count;
  }();
  // In an empty volume everything beyond is set: the mirror image of what is seen, without the
  // plane of the centre.
  const BallMoments m = empty.continued({0, 20, 20}, beyond);
  EXPECT_TRUE(beyond);
  EXPECT_GT(m.count, 0);
  EXPECT_LT(m.count, seen);
  EXPECT_LT(m.first[0], 0);
}

TEST(ContinuedBall, NormalsOfACutPlaneStayNearTheTruth) {
  const Vec3 n = Vec3(1, 2, 3).normalized();
  const BinaryVolume volume = half_space(n, {30, 30, 29}, {0, 0, 0}, {30, 30, 30});
  const auto [whole, cut] = test::expect_near_truth_at_open_border(volume, n);
  EXPECT_GT(cut.worst, 2 * whole.worst);
  EXPECT_GT(cut.mean, 2 * whole.mean);
}

}  // namespace
}  // namespace dsc
