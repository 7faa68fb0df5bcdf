// Balls by bricks against the plain scan of their rows.
#include "libdsc/normals/brick_scan.h"

#include "libdsc/base/error.h"
#include "libdsc/normals/brick_kernel.h"
#include "libdsc/normals/integral_invariant.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/shapes.h"
#include "tests/normals/normals_support.h"

#include <gtest/gtest.h>

#include <mutex>

namespace dsc {
namespace {

Index3 doubled_centre(const Surfel& s) {
  Index3 c{2 * Index{s.x}, 2 * Index{s.y}, 2 * Index{s.z}};
  c[static_cast<std::size_t>(s.axis())] += s.sign();
  return c;
}

/// Surfels anywhere in the grid and `beyond` voxels outside: they need not separate anything.
std::vector<Surfel> random_surfels(const Grid& grid, Index beyond, int count, unsigned seed) {
  std::mt19937 random(seed);
  const auto place = [&](std::size_t a) {
    return static_cast<std::int32_t>(
        std::uniform_int_distribution<Index>(-beyond, grid.size[a] - 1 + beyond)(random));
  };
  std::vector<Surfel> surfels;
  for (int i = 0; i < count; ++i) {
    surfels.push_back(
        {place(0), place(1), place(2), std::uniform_int_distribution<int>(0, 5)(random)});
  }
  return surfels;
}

void expect_equal_to_plain(const BinaryVolume& volume, double radius,
                           const std::vector<Surfel>& surfels) {
  const Ball ball(radius, volume.grid().spacing);
  ASSERT_TRUE(bricks_serve(ball));
  const BallScanner scan(volume, radius, BallScanner::Centres::surfels);
  std::vector<BallMoments> moments(surfels.size());
  std::vector<int> visits(surfels.size(), 0);
  brick_scan(volume, ball, surfels, [&](Index i, const BallMoments& m) {
    moments[static_cast<std::size_t>(i)] = m;
    ++visits[static_cast<std::size_t>(i)];
  });
  for (std::size_t i = 0; i < surfels.size(); ++i) {
    ASSERT_EQ(visits[i], 1);
    ASSERT_EQ(moments[i], scan.plain(doubled_centre(surfels[i]))) << radius << ", surfel " << i;
  }
}

class BrickScan : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!detail::has_brick_kernel()) GTEST_SKIP() << "this machine has no AVX2";
  }
};

TEST_F(BrickScan, KernelCountsWhatTheMaskLeaves) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 2000; ++round) {
    BrickBits bits, mask, both;
    for (std::size_t z = 0; z < bits.size(); ++z) {
      bits[z] = round % 3 == 0 ? ~std::uint64_t{0} : random();
      mask[z] = round % 3 == 1 ? ~std::uint64_t{0} : random() | random();
      if (round % 5 == 4) bits[z] = ~std::uint64_t{0}, mask[z] = ~std::uint64_t{0};
      both[z] = bits[z] & mask[z];
    }
    ASSERT_EQ(detail::masked_brick_sums(bits, mask), brick_sums(both)) << round;
  }
}

TEST_F(BrickScan, EqualsThePlainScanForEveryRadius) {
  const Grid grid{{70, 41, 37}};
  for (const double density : {0.5, 0.97, 0.02}) {
    const BinaryVolume volume = test::random_volume(grid, density, 1);
    const std::vector<Surfel> surfels = random_surfels(grid, 9, 60, 2);
    for (double r = 0.5; r < 45; r = 1.13 * r + 0.31) expect_equal_to_plain(volume, r, surfels);
  }
}

TEST_F(BrickScan, EqualsThePlainScanAtEverySurfelOfASolid) {
  const BinaryVolume volume = digitize(Sphere(), Vec3::Constant(1. / 20));
  const DigitalSurface surface = extract_surface(volume);
  const std::vector<Surfel> surfels(surface.surfels().begin(), surface.surfels().end());
  for (const double r : {6., 13.4, 25.}) expect_equal_to_plain(volume, r / 20, surfels);
}

TEST_F(BrickScan, EqualsThePlainScanWhereSpacingDiffers) {
  for (const Vec3& spacing : {Vec3(1, 1, 5), Vec3(0.31, 0.17, 0.23), Vec3(4, 1, 0.7)}) {
    Grid grid{{60, 40, 30}};
    grid.spacing = spacing;
    const BinaryVolume volume = test::random_volume(grid, 0.5, 4);
    for (const double voxels : {2.3, 9.1}) {
      expect_equal_to_plain(volume, voxels * spacing.maxCoeff(), random_surfels(grid, 4, 40, 5));
    }
  }
}

// Sums are largest where everything is inside.
TEST_F(BrickScan, LargestBallsDoNotOverflow) {
  BinaryVolume volume(Grid{{420, 420, 420}});
  for (Index z = 0; z < 420; ++z) {
    for (Index y = 0; y < 420; ++y) {
      for (Index x = 0; x < 420; ++x) volume.set(x, y, z);
    }
  }
  const std::vector<Surfel> surfels = {{209, 210, 211, 1}, {210, 208, 210, 2}, {30, 400, 210, 5}};
  expect_equal_to_plain(volume, 200, surfels);
  EXPECT_FALSE(bricks_serve(Ball(201, {1, 1, 1})));
}

// Bricks fill the box of all balls: hundreds of GB here.
TEST_F(BrickScan, DoesNotPayInVastVolumes) {
  std::vector<Surfel> surfels(200000, {10, 10, 10, 1});
  const Ball ball(12, {1, 1, 1});
  EXPECT_TRUE(bricks_pay(ball, surfels));
  surfels.back() = {20000, 20000, 20000, 1};
  EXPECT_FALSE(bricks_pay(ball, surfels));
}

TEST_F(BrickScan, ServesTheEstimatorOnLargeSurfaces) {
  const double h = 1. / 73;
  const BinaryVolume volume = digitize(Sphere(), Vec3::Constant(h));
  const DigitalSurface surface = extract_surface(volume);
  const std::span<const Surfel> surfels = surface.surfels();
  const double radius = 11. * h;
  ASSERT_TRUE(bricks_pay(Ball(radius, Vec3::Constant(h)), surfels));
  const BallScanner scan(volume, radius, BallScanner::Centres::surfels);
  Index equal = 0;
  std::mutex mutex;
  visit_balls(volume, surfels, {radius}, [&](Index i, std::span<const BallMoments> balls) {
    const bool same =
        balls.size() == 1 && balls[0] == scan(doubled_centre(surfels[static_cast<std::size_t>(i)]));
    const std::lock_guard<std::mutex> lock(mutex);
    equal += same ? 1 : 0;
  });
  EXPECT_EQ(equal, surface.face_count());
}

}  // namespace
}  // namespace dsc
