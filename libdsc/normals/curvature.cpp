#include "libdsc/normals/curvature.h"

#include "libdsc/base/parallel.h"
#include "libdsc/base/tangent_eigen.h"
#include "libdsc/normals/flattest_direction.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <numbers>

namespace dsc {
namespace {

/// What a half space through the centre of a surfel has in its ball.
struct HalfBall {
  double volume = 0;
  Mat3 second = Mat3::Zero();  ///< about the centre
  double r4 = 0, r6 = 0;       ///< r^4 and r^6, as the discs of the digital ball have them
};

/// Points of a ball beyond which it is as good as the smooth one, and too large to visit.
constexpr double kManyPoints = 1e7;

/// The lattice points of the ball along rows, all of them set: half of their sums.
HalfBall half_ball(const Ball& ball, int axis, double voxel) {
  Index3 parity{0, 0, 0};
  parity[static_cast<std::size_t>(axis)] = 1;
  const BallRows rows(ball, parity);
  const Vec3 h = ball.spacing();
  const double r = ball.radius();
  const bool visit = 4.2 * r * r * r < kManyPoints * voxel;
  double count = 0, lengths = 0, cubes = 0;
  Vec3 squares = Vec3::Zero();
  for (Index dz = -rows.reach(2); dz <= rows.reach(2); dz += 2) {
    for (Index dy = -rows.reach(1); dy <= rows.reach(1); dy += 2) {
      const Index extent = rows.extent(dy, dz);
      if (extent < 0) continue;
      const auto n = static_cast<double>(extent + 1);  // dx = -extent, -extent + 2, …
      const auto x = static_cast<double>(extent), y = static_cast<double>(dy),
                 z = static_cast<double>(dz);
      count += n;
      squares += n * Vec3(x * (x + 2) / 3., y * y, z * z);
      for (Index dx = -extent; visit && dx <= extent; dx += 2) {
        const double d = 0.5 * h.cwiseProduct(Vec3(static_cast<double>(dx), y, z)).norm();
        lengths += d;
        cubes += d * d * d;
      }
    }
  }
  HalfBall half;
  half.volume = 0.5 * voxel * count;
  half.second = (0.125 * voxel * squares.cwiseProduct(h).cwiseProduct(h)).asDiagonal();
  half.r4 = visit ? voxel * lengths / std::numbers::pi : std::pow(r, 4);
  half.r6 = visit ? 1.5 * voxel * cubes / std::numbers::pi : std::pow(r, 6);
  return half;
}

/// H, kappa_1, kappa_2.
Vec3 curvatures(double volume, double e1, double e2, const HalfBall& flat, CurvatureForm form) {
  const double from_volume = volume / (std::numbers::pi * flat.r4);
  const double scale = 1. / (std::numbers::pi * flat.r6);
  if (form == CurvatureForm::plain) {
    return {-4. * from_volume, 6. * (e2 - 3. * e1) * scale, 6. * (e1 - 3. * e2) * scale};
  }
  const double mean = 12. * from_volume - 24. * (e1 + e2) * scale;
  const double half = 12. * (e1 - e2) * scale;
  return {mean, mean - half, mean + half};
}

}  // namespace

CurvatureField integral_invariant_curvatures(const BinaryVolume& volume,
                                             std::span<const Surfel> surfels,
                                             const CurvatureOptions& options,
                                             const Context& context) {
  const auto n = static_cast<Index>(surfels.size());
  const double r = options.radius;
  const Vec3 spacing = volume.grid().spacing;
  const double voxel = spacing.prod();
  const Ball ball(r, spacing);
  const std::array<HalfBall, 3> half = {half_ball(ball, 0, voxel), half_ball(ball, 1, voxel),
                                        half_ball(ball, 2, voxel)};
  context.begin("curvature", n);
  context.need("curvature", (4 * 8 + 3 * 24 + 1) * n);
  CurvatureField field;
  field.radius = r;
  for (Eigen::VectorXd* values : {&field.mean, &field.gaussian, &field.kappa_1, &field.kappa_2}) {
    values->resize(n);
  }
  for (Eigen::Matrix3Xd* vectors : {&field.direction_1, &field.direction_2, &field.normals}) {
    vectors->resize(3, n);
  }
  std::vector<char> fallback(surfels.size(), 0);
  field.cut_faces = visit_balls(
      volume, surfels, {r, BallCentre::surfel, options.beyond},
      [&](Index i, std::span<const BallMoments> balls) {
        const Surfel& surfel = surfels[static_cast<std::size_t>(i)];
        const HalfBall& flat = half[static_cast<std::size_t>(surfel.axis())];
        const Mat3 v = covariance(balls[0], spacing);
        Vec3 normal = flattest_direction(v, surfel.normal());
        if (normal.isZero(0)) {
          normal = surfel.normal();
          fallback[static_cast<std::size_t>(i)] = 1;
        }
        const TangentEigen excess = tangent_eigen(v - flat.second, normal);
        const double volume_excess = voxel * static_cast<double>(balls[0].count) - flat.volume;
        const Vec3 h = curvatures(volume_excess, excess.high, excess.low, flat, options.form);
        field.mean[i] = h[0];
        field.kappa_1[i] = h[1];
        field.kappa_2[i] = h[2];
        field.gaussian[i] = h[1] * h[2];
        field.direction_1.col(i) = excess.high_direction;
        field.direction_2.col(i) = normal.cross(excess.high_direction);
        field.normals.col(i) = normal;
      },
      context);
  for (const char flag : fallback) field.fallbacks += flag;
  return field;
}

}  // namespace dsc
