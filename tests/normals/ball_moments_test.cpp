#include "libdsc/normals/ball_moments.h"

#include "libdsc/base/error.h"
#include "tests/normals/normals_support.h"

#include <gtest/gtest.h>

#include <limits>

namespace dsc {
namespace {

using Centres = BallScanner::Centres;

/// Every lattice point of the bounding cube, tested one by one; `inside(dx, dy, dz)` is the ball.
template <class Inside>
BallMoments brute_force(const BinaryVolume& volume, const Index3& c, const Index3& reach,
                        Inside inside) {
  BallMoments m;
  const auto low = [&](std::size_t a) { return (c[a] - reach[a]) / 2 - 2; };
  const auto high = [&](std::size_t a) { return (c[a] + reach[a]) / 2 + 2; };
  for (Index x = low(0); x <= high(0); ++x) {
    for (Index y = low(1); y <= high(1); ++y) {
      for (Index z = low(2); z <= high(2); ++z) {
        const Index d[3] = {2 * x - c[0], 2 * y - c[1], 2 * z - c[2]};
        if (!volume(x, y, z) || !inside(d[0], d[1], d[2])) continue;
        ++m.count;
        for (std::size_t a = 0; a < 3; ++a) m.first[a] += d[a];
        const Index products[6] = {d[0] * d[0], d[1] * d[1], d[2] * d[2],
                                   d[0] * d[1], d[0] * d[2], d[1] * d[2]};
        for (std::size_t k = 0; k < 6; ++k) m.second[k] += products[k];
      }
    }
  }
  return m;
}

/// The integers alone: |d|^2 <= floor(4 R^2), R in voxels.
BallMoments brute_force(const BinaryVolume& volume, const Index3& c, double radius) {
  const Index limit = static_cast<Index>(std::floor(4 * radius * radius));
  const Index reach = 2 * static_cast<Index>(radius) + 2;
  return brute_force(volume, c, {reach, reach, reach}, [&](Index dx, Index dy, Index dz) {
    return dx * dx + dy * dy + dz * dz <= limit;
  });
}

/// Centres of one kind (odd axis or -1) all over the grid and `beyond` voxels outside of it.
std::vector<Index3> random_centres(const Grid& grid, int odd_axis, Index beyond, int count,
                                   unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Index3> centres;
  for (int i = 0; i < count; ++i) {
    Index3 c{};
    for (std::size_t a = 0; a < 3; ++a) {
      std::uniform_int_distribution<Index> place(-beyond, grid.size[a] - 1 + beyond);
      c[a] = 2 * place(random) + (static_cast<int>(a) == odd_axis ? 1 : 0);
    }
    centres.push_back(c);
  }
  return centres;
}

void expect_equal_to_brute_force(const BinaryVolume& volume, double radius, Centres centres,
                                 int count) {
  const BallScanner scan(volume, radius, centres);
  const int kinds = centres == Centres::voxels ? 1 : 3;
  for (int kind = 0; kind < kinds; ++kind) {
    const int odd = centres == Centres::voxels ? -1 : kind;
    for (const Index3& c : random_centres(volume.grid(), odd, 3, count, 7)) {
      const BallMoments truth = brute_force(volume, c, radius);
      ASSERT_EQ(scan.plain(c), truth) << radius << " at " << c[0] << " " << c[1] << " " << c[2];
      ASSERT_EQ(scan(c), truth) << radius << " at " << c[0] << " " << c[1] << " " << c[2];
    }
  }
}

TEST(BallMoments, EqualBruteForceForEveryRadius) {
  const Grid grid{{150, 71, 40}};
  const BinaryVolume half = test::random_volume(grid, 0.5, 1);
  for (int r = 1; r <= 40; ++r) {
    const int count = r < 12 ? 40 : 6;
    expect_equal_to_brute_force(half, r, Centres::surfels, count);
    expect_equal_to_brute_force(half, r, Centres::voxels, count);
    expect_equal_to_brute_force(half, r + 0.37, Centres::surfels, count);
  }
}

TEST(BallMoments, EqualBruteForceForBallsOfManyBlocks) {
  const BinaryVolume volume = test::random_volume({{180, 150, 140}}, 0.5, 11);
  for (const double r : {48., 66.6}) {
    expect_equal_to_brute_force(volume, r, Centres::surfels, 2);
    expect_equal_to_brute_force(volume, r, Centres::voxels, 2);
  }
}

TEST(BallMoments, EqualBruteForceOnFullAndSparseVolumes) {
  const Grid grid{{130, 20, 33}};
  for (const double density : {1., 0.97, 0.02}) {
    const BinaryVolume volume = test::random_volume(grid, density, 2);
    for (const double r : {0.4, 0.5, 0.9, 3., 6.5, 15.5, 21., 31., 33.3}) {
      expect_equal_to_brute_force(volume, r, Centres::surfels, 8);
      expect_equal_to_brute_force(volume, r, Centres::voxels, 8);
    }
  }
}

TEST(BallMoments, EqualBruteForceInTinyVolumes) {
  for (const Index3& size :
       {Index3{1, 1, 1}, Index3{2, 1, 3}, Index3{62, 1, 1}, Index3{63, 2, 1}}) {
    const BinaryVolume volume = test::random_volume({size}, 0.8, 3);
    for (const double r : {1., 2.5, 7., 30., 45.}) {
      expect_equal_to_brute_force(volume, r, Centres::surfels, 8);
    }
  }
}

TEST(BallMoments, BallIsRoundInTheWorldWhereSpacingDiffers) {
  std::mt19937 random(5);
  for (const Vec3& spacing : {Vec3(1, 1, 5), Vec3(0.31, 0.17, 0.23), Vec3(4, 1, 0.7)}) {
    Grid grid{{70, 40, 30}};
    grid.spacing = spacing;
    const BinaryVolume volume = test::random_volume(grid, 0.5, 4);
    for (const double voxels : {1., 2.3, 6., 9.1}) {
      const double radius = voxels * spacing.maxCoeff();
      const BallScanner scan(volume, radius, Centres::surfels);
      for (int odd = 0; odd < 3; ++odd) {
        for (const Index3& c : random_centres(grid, odd, 3, 8, 9)) {
          Index3 reach{};
          for (std::size_t a = 0; a < 3; ++a) {
            reach[a] = 2 * static_cast<Index>(radius / spacing[static_cast<int>(a)]) + 2;
          }
          // World distances in extended precision: no point here is near enough to the sphere to
          // tell the difference from the rounding of Ball::contains.
          const auto inside = [&](Index dx, Index dy, Index dz) {
            const long double x = static_cast<long double>(spacing[0]) * dx / 2;
            const long double y = static_cast<long double>(spacing[1]) * dy / 2;
            const long double z = static_cast<long double>(spacing[2]) * dz / 2;
            return x * x + y * y + z * z <=
                   static_cast<long double>(radius) * radius * (1 + 0x1p-40L);
          };
          const BallMoments truth = brute_force(volume, c, reach, inside);
          ASSERT_EQ(scan.plain(c), truth);
          ASSERT_EQ(scan(c), truth);
        }
      }
    }
  }
}

TEST(BallMoments, FullBallCountsDoNotDependOnTheGridstep) {
  // r = 6h must hold the points at distance 6h for every h, however 6h is rounded.
  for (const double h : {1., 0.1, 0.3, 1. / 7, 1e-5, 12345.678}) {
    const Ball ball(6 * h, Vec3::Constant(h));
    EXPECT_TRUE(ball.contains(12, 0, 0)) << h;
    EXPECT_TRUE(ball.contains(0, 0, -12)) << h;
    EXPECT_TRUE(ball.contains(8, -8, 4)) << h;
    EXPECT_FALSE(ball.contains(12, 1, 0)) << h;
  }
}

TEST(BallMoments, CovarianceIsThatOfThePoints) {
  Grid grid{{9, 8, 7}};
  grid.spacing = Vec3(0.5, 1.25, 2);
  const BinaryVolume volume = test::random_volume(grid, 0.4, 6);
  const double radius = 4;
  const Index3 centre{8, 8, 7};
  std::vector<Vec3> points;
  for (Index z = 0; z < 7; ++z) {
    for (Index y = 0; y < 8; ++y) {
      for (Index x = 0; x < 9; ++x) {
        const Vec3 p = grid.position(double(x), double(y), double(z));
        if (volume(x, y, z) && (p - grid.position(4, 4, 3.5)).norm() <= radius) points.push_back(p);
      }
    }
  }
  ASSERT_GT(points.size(), 20u);
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points) mean += p / double(points.size());
  Mat3 truth = Mat3::Zero();
  for (const Vec3& p : points) truth += grid.spacing.prod() * (p - mean) * (p - mean).transpose();
  const BallScanner scan(volume, radius, Centres::surfels);
  EXPECT_LT((covariance(scan(centre), grid.spacing) - truth).norm(), 1e-12 * truth.norm());
  EXPECT_TRUE(covariance(BallMoments{}, grid.spacing).isZero(0));
}

TEST(BallMoments, RefusesWhatCannotBeCounted) {
  const BinaryVolume volume{Grid{{3, 3, 3}}};
  EXPECT_THROW(BallScanner(volume, 5000, Centres::surfels), LimitError);
  EXPECT_THROW(BallScanner(volume, 1e300, Centres::surfels), LimitError);
  for (const double bad : {0., -1., std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(BallScanner(volume, bad, Centres::surfels), UsageError);
  }
  EXPECT_THROW(BallScanner(volume, 2, Centres::surfels)({0, 0, 0}), UsageError);
  EXPECT_THROW(BallScanner(volume, 2, Centres::voxels)({1, 0, 0}), UsageError);
  EXPECT_THROW(BallScanner(volume, 2, Centres::surfels)({1, 1, 0}), UsageError);
}

}  // namespace
}  // namespace dsc
