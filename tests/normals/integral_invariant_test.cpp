#include "libdsc/normals/integral_invariant.h"

#include "libdsc/base/error.h"
#include "libdsc/normals/radius.h"
#include "tests/normals/normals_support.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <numbers>

namespace dsc {
namespace {

double degrees(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

void expect_unit_and_outward(const NormalField& field, const std::vector<Surfel>& surfels) {
  ASSERT_EQ(field.u.cols(), static_cast<Index>(surfels.size()));
  for (Index i = 0; i < field.u.cols(); ++i) {
    ASSERT_NEAR(field.u.col(i).norm(), 1, 1e-14);
    ASSERT_GT(field.u.col(i).dot(surfels[static_cast<std::size_t>(i)].normal()), 0);
  }
}

struct SphereError {
  double mean = 0, max = 0;
};

SphereError sphere_error(double h, BallCentre centre) {
  const BinaryVolume volume = test::digital_sphere(1, h);
  const std::vector<Surfel> surfels = test::all_surfels(volume);
  const NormalField field = integral_invariant_normals(volume, surfels, {shape_radius(h), centre});
  EXPECT_EQ(field.fallbacks, 0);
  EXPECT_EQ(field.radius, shape_radius(h));
  expect_unit_and_outward(field, surfels);
  SphereError error;
  for (std::size_t i = 0; i < surfels.size(); ++i) {
    const Vec3 truth = surfels[i].centre(volume.grid()).normalized();
    const double angle = degrees(field.u.col(static_cast<Index>(i)), truth);
    error.mean += angle / static_cast<double>(surfels.size());
    error.max = std::max(error.max, angle);
  }
  return error;
}

TEST(IntegralInvariant, ConvergesOnTheSphere) {
  // Single gridsteps scatter by a factor of two (the sphere and the ball meet the lattice by
  // chance), so the order is that of a line fitted through several. peers.md has 0.34, 0.096, 0.098
  // degrees at 0.1, 0.05, 0.025 from another program's pairs of voxels.
  for (const BallCentre centre : {BallCentre::surfel, BallCentre::voxel_pair}) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (const double h : {0.2, 0.14, 0.1, 0.0987, 0.083, 0.07, 0.05, 0.0441, 0.035, 0.025}) {
      const SphereError error = sphere_error(h, centre);
      EXPECT_LT(error.mean, 8. * h) << h;  // degrees
      EXPECT_LT(error.max, 18. * h) << h;
      const double x = std::log(h), y = std::log(error.mean);
      n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    EXPECT_GT((n * sxy - sx * sy) / (n * sxx - sx * sx), 0.8);
  }
}

TEST(IntegralInvariant, HalfSpacesHaveTheirAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      Grid grid{{33, 34, 35}};
      grid.spacing = Vec3(1, 2, 0.7);
      const BinaryVolume volume = test::fill(
          grid, [&](const Vec3& p) { return side * (p[axis] / grid.spacing[axis] - 16.5) < 0; });
      const Surfel surfel{axis == 0 && side < 0 ? 17 : 16, axis == 1 && side < 0 ? 17 : 16,
                          axis == 2 && side < 0 ? 17 : 16, 2 * axis + (side + 1) / 2};
      for (const BallCentre centre : {BallCentre::surfel, BallCentre::voxel_pair}) {
        const NormalField field = integral_invariant_normals(volume, {&surfel, 1}, {7., centre});
        EXPECT_EQ(field.fallbacks, 0);
        EXPECT_EQ(field.u.col(0), surfel.normal());
      }
    }
  }
}

TEST(IntegralInvariant, FollowsTheWorldWhereSpacingDiffers) {
  const Vec3 truth = Vec3(1, 2, 2) / 3;
  Grid grid{{60, 60, 24}};
  grid.spacing = Vec3(1, 1, 2.5);
  const Vec3 middle = grid.position(30, 30, 12);
  const BinaryVolume volume =
      test::fill(grid, [&](const Vec3& p) { return (p - middle).dot(truth) < 0; });
  std::vector<Surfel> surfels;
  for (const Surfel& s : test::all_surfels(volume)) {
    if ((s.centre(grid) - middle).norm() < 8) surfels.push_back(s);
  }
  ASSERT_GT(surfels.size(), 100u);
  const NormalField field = integral_invariant_normals(volume, surfels, {15});
  for (Index i = 0; i < field.u.cols(); ++i) EXPECT_LT(degrees(field.u.col(i), truth), 2.);
}

TEST(IntegralInvariant, FallsBackWhereTheShapeHasNoNormal) {
  const BinaryVolume single =
      test::fill(Grid{{3, 3, 3}}, [](const Vec3& p) { return p == Vec3(1, 1, 1); });
  const BinaryVolume line =
      test::fill(Grid{{30, 3, 3}}, [](const Vec3& p) { return p[1] == 1 && p[2] == 1; });
  const BinaryVolume full = test::fill(Grid{{5, 5, 5}}, [](const Vec3&) { return true; });
  for (const BinaryVolume* volume : {&single, &line, &full}) {
    const std::vector<Surfel> surfels = test::all_surfels(*volume);
    const double radius = volume == &full ? 0.3 : 4.;  // 0.3: no lattice point in the ball
    const NormalField field = integral_invariant_normals(*volume, surfels, {radius});
    EXPECT_EQ(field.fallbacks, static_cast<Index>(surfels.size()));
    for (std::size_t i = 0; i < surfels.size(); ++i) {
      EXPECT_EQ(field.u.col(static_cast<Index>(i)), surfels[i].normal());
    }
  }
}

TEST(IntegralInvariant, NeverAnswersNaN) {
  for (const double density : {0.1, 0.5, 0.9}) {
    const BinaryVolume volume = test::random_volume(Grid{{20, 15, 10}}, density, 3);
    const std::vector<Surfel> surfels = test::all_surfels(volume);
    for (const double radius : {0.5, 1., 1.5, 2., 40.}) {
      for (const BallCentre centre : {BallCentre::surfel, BallCentre::voxel_pair}) {
        expect_unit_and_outward(integral_invariant_normals(volume, surfels, {radius, centre}),
                                surfels);
      }
    }
  }
}

TEST(IntegralInvariant, GivesTheSameBitsForAnyThreadCount) {
  const BinaryVolume volume = test::digital_sphere(1, 0.08);
  const std::vector<Surfel> surfels = test::all_surfels(volume);
  Context context;
  context.threads = 1;
  const NormalField one = integral_invariant_normals(volume, surfels, {0.6}, context);
  for (const int threads : {2, 4, 8}) {
    context.threads = threads;
    const NormalField many = integral_invariant_normals(volume, surfels, {0.6}, context);
    EXPECT_EQ(many.u, one.u);
    EXPECT_EQ(many.fallbacks, one.fallbacks);
  }
}

TEST(IntegralInvariant, ChecksItsOptionsAndStopsWhenAsked) {
  const BinaryVolume volume = test::digital_sphere(1, 0.2);
  const std::vector<Surfel> surfels = test::all_surfels(volume);
  EXPECT_THROW(integral_invariant_normals(volume, surfels, {}), UsageError);
  EXPECT_THROW(integral_invariant_normals(volume, surfels, {-1.}), UsageError);
  EXPECT_EQ(integral_invariant_normals(volume, {}, {1.}).u.cols(), 0);
  Monitor monitor;
  monitor.cancel();
  EXPECT_THROW(integral_invariant_normals(volume, surfels, {1.}, {1, &monitor}), Cancelled);
}

TEST(Radius, CountsVoxelsOfTheCoarsestAxis) {
  EXPECT_DOUBLE_EQ(shape_radius(0.04), 0.6);
  EXPECT_DOUBLE_EQ(data_radius(Vec3(1, 5, 2), 3), 15);
  EXPECT_THROW(shape_radius(0), UsageError);
  EXPECT_THROW(shape_radius(-1), UsageError);
  EXPECT_THROW(data_radius(Vec3(1, 1, 1), 0), UsageError);
}

}  // namespace
}  // namespace dsc
