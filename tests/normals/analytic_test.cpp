#include "libdsc/normals/analytic.h"

#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/shapes.h"
#include "tests/normals/normals_support.h"

#include <gtest/gtest.h>

namespace dsc {
namespace {

TEST(AnalyticNormals, AreRadialOnTheSphereAndConstantOnThePlane) {
  const Vec3 middle(0.1, -0.2, 0.05);
  const Sphere sphere(1, middle);
  const BinaryVolume ball = digitize(sphere, Vec3(0.1, 0.12, 0.08));
  const std::vector<Surfel> surfels = test::all_surfels(ball);
  const NormalField field = analytic_normals(sphere, ball.grid(), surfels);
  ASSERT_EQ(field.u.cols(), static_cast<Index>(surfels.size()));
  EXPECT_EQ(field.fallbacks, 0);
  for (std::size_t i = 0; i < surfels.size(); ++i) {
    const Vec3 truth = (surfels[i].centre(ball.grid()) - middle).normalized();
    EXPECT_LT((field.u.col(static_cast<Index>(i)) - truth).norm(), 1e-12);
  }

  const Plane plane(Vec3(1, 2, -2), 0.3, 4);
  const BinaryVolume half = digitize(plane, Vec3::Constant(0.25));
  const NormalField flat = analytic_normals(plane, half.grid(), test::all_surfels(half));
  EXPECT_EQ(flat.fallbacks, 0);
  EXPECT_LT((flat.u.colwise() - Vec3(1, 2, -2) / 3).colwise().norm().maxCoeff(), 1e-12);
}

TEST(AnalyticNormals, AreOrthogonalToTheSurfaceWithoutAClosedForm) {
  // x/a etc.: the normal at the foot q is along the residual centre - q.
  const Ellipsoid shape(Vec3(1, 0.8, 0.6));
  const BinaryVolume volume = digitize(shape, Vec3::Constant(0.07));
  const std::vector<Surfel> surfels = test::all_surfels(volume);
  const NormalField field = analytic_normals(shape, volume.grid(), surfels);
  EXPECT_EQ(field.fallbacks, 0);
  for (std::size_t i = 0; i < surfels.size(); ++i) {
    // Walk from the centre along +-u to the surface: f has a root there, and u is its normal.
    const Vec3 p = surfels[i].centre(volume.grid());
    const Vec3 u = field.u.col(static_cast<Index>(i));
    double t = 0;
    for (int k = 0; k < 50; ++k) t -= shape.value(p + t * u) / shape.gradient(p + t * u).dot(u);
    EXPECT_LT((shape.gradient(p + t * u).normalized() - u).norm(), 1e-6);
  }
}

/// A shape whose projection always fails.
class Nowhere final : public ImplicitShape {
 public:
  double value(const Vec3&) const override { return 1; }
  Vec3 gradient(const Vec3&) const override { return Vec3::Zero(); }
  Mat3 hessian(const Vec3&) const override { return Mat3::Zero(); }
  Eigen::AlignedBox3d bounds() const override { return {Vec3::Constant(-1.), Vec3::Constant(1.)}; }
  std::string name() const override { return "nowhere"; }
};

TEST(AnalyticNormals, FallBackToTheSurfelWhereTheProjectionFails) {
  const std::vector<Surfel> surfels{{0, 0, 0, 3}, {1, 0, 0, 4}};
  const NormalField field = analytic_normals(Nowhere(), Grid{{2, 2, 2}}, surfels);
  EXPECT_EQ(field.fallbacks, 2);
  EXPECT_EQ(field.u.col(0), Vec3(0, 1, 0));
  EXPECT_EQ(field.u.col(1), Vec3(0, 0, -1));
}

}  // namespace
}  // namespace dsc
