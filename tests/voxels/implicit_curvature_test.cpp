#include "libdsc/voxels/implicit_curvature.h"

#include "libdsc/voxels/closest_point.h"
#include "libdsc/voxels/shape_spec.h"
#include "libdsc/voxels/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dsc {
namespace {

TEST(ImplicitCurvature, OfASphereIsTheInverseOfItsRadius) {
  const Sphere sphere(2.5, Vec3(1, 2, 3));
  const auto c = implicit_curvature(sphere, Vec3(1, 2, 3) + 2.5 * Vec3(2, -1, 2) / 3.);
  ASSERT_TRUE(c);
  EXPECT_NEAR(c->mean, 0.4, 1e-14);
  EXPECT_NEAR(c->gaussian, 0.16, 1e-14);
  EXPECT_NEAR(c->kappa_1, 0.4, 1e-14);
  EXPECT_NEAR(c->kappa_2, 0.4, 1e-14);
  EXPECT_LT((c->normal - Vec3(2, -1, 2) / 3.).norm(), 1e-14);
}

TEST(ImplicitCurvature, OfATorusFollowsItsAngle) {
  const double R = 1.2, r = 0.45;
  const Torus torus(R, r);
  for (const double phi : {0.3, 1.9, 4.}) {
    for (const double theta : {0., 0.8, 1.7, 2.9, 5.}) {
      const Vec3 out(std::cos(phi), std::sin(phi), 0), round(-std::sin(phi), std::cos(phi), 0);
      const Vec3 n = std::cos(theta) * out + std::sin(theta) * Vec3::UnitZ();
      const auto c = implicit_curvature(torus, R * out + r * n);
      ASSERT_TRUE(c);
      // Along the tube's circle 1/r, around the axis cos(theta) / (distance from the axis).
      EXPECT_NEAR(c->kappa_2, 1 / r, 1e-12);
      EXPECT_NEAR(c->kappa_1, std::cos(theta) / (R + r * std::cos(theta)), 1e-12);
      EXPECT_NEAR(c->mean, 0.5 * (c->kappa_1 + c->kappa_2), 1e-12);
      EXPECT_NEAR(c->gaussian, c->kappa_1 * c->kappa_2, 1e-12);
      EXPECT_NEAR(std::abs(c->direction_1.dot(round)), 1, 1e-12);
      EXPECT_LT((c->normal - n).norm(), 1e-12);
    }
  }
}

TEST(ImplicitCurvature, AtTheTipsOfAnEllipsoidIsThatOfItsSections) {
  const double a = 1.5, b = 0.8, c = 0.6;
  const auto at = implicit_curvature(Ellipsoid(Vec3(a, b, c)), Vec3(0, b, 0));
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->kappa_1, b / (a * a), 1e-13);
  EXPECT_NEAR(at->kappa_2, b / (c * c), 1e-13);
  EXPECT_NEAR(std::abs(at->direction_1.x()), 1, 1e-13);
  EXPECT_NEAR(std::abs(at->direction_2.z()), 1, 1e-13);
}

/// H is half the divergence of the unit normal, here by differences of the gradient alone.
TEST(ImplicitCurvature, MeanIsHalfTheDivergenceOfTheNormal) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (const char* spec : {"goursat", "leopold", "rounded-cube", "ellipsoid"}) {
    SCOPED_TRACE(spec);
    const auto shape = make_shape(spec);
    for (int i = 0; i < 20; ++i) {
      const Vec3 start = 0.4 * shape->bounds().sizes().maxCoeff() *
                         Vec3(normal(random), normal(random), normal(random)).normalized();
      const ClosestPoint q = closest_point(*shape, start);
      const auto c = implicit_curvature(*shape, q.point);
      if (!q.converged || !c) continue;
      const double s = 1e-5 / (1. + std::abs(c->kappa_1) + std::abs(c->kappa_2));
      double divergence = 0;
      for (int k = 0; k < 3; ++k) {
        const Vec3 e = s * Vec3::Unit(k);
        divergence += (shape->gradient(q.point + e).normalized()[k] -
                       shape->gradient(q.point - e).normalized()[k]) /
                      (2 * s);
      }
      EXPECT_NEAR(c->mean, 0.5 * divergence, 1e-5 * (1. + std::abs(c->mean)));
    }
  }
}

TEST(ImplicitCurvature, IsNotDefinedWhereTheGradientVanishes) {
  EXPECT_FALSE(implicit_curvature(Sphere(1.), Vec3::Zero()));
  EXPECT_TRUE(implicit_curvature(Plane(Vec3(1, 2, 3)), Vec3::Zero()));
}

}  // namespace
}  // namespace dsc
