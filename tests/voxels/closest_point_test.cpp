#include "libdsc/voxels/closest_point.h"

#include "libdsc/base/error.h"
#include "libdsc/voxels/shape_spec.h"
#include "libdsc/voxels/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dsc {
namespace {

/// n points at distance up to `reach` from the surface, found by bisection along random segments.
std::vector<Vec3> points_near(const ImplicitShape& shape, int n, double reach, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  const Eigen::AlignedBox3d box = shape.bounds();
  const auto in_box = [&] {
    const Vec3 t(uniform(random), uniform(random), uniform(random));
    return Vec3(box.center() + 0.5 * box.sizes().cwiseProduct(t));
  };
  std::vector<Vec3> points;
  while (static_cast<int>(points.size()) < n) {
    Vec3 a = in_box();
    Vec3 b = in_box();
    if (!(shape.value(a) < 0) || shape.value(b) < 0) continue;
    for (int k = 0; k < 60; ++k) {
      const Vec3 m = 0.5 * (a + b);
      (shape.value(m) < 0 ? a : b) = m;
    }
    points.push_back(a + reach * uniform(random) * shape.gradient(a).normalized());
  }
  return points;
}

TEST(ClosestPoint, NewtonAgreesWithTheClosedForms) {
  for (const char* spec : {"sphere,r=2,cx=1,cy=-1,cz=0.5", "torus,R=1,r=0.4", "plane,d=0.3"}) {
    SCOPED_TRACE(spec);
    const auto shape = make_shape(spec);
    for (const Vec3& p : points_near(*shape, 300, 0.3, 1)) {
      const ClosestPoint newton = closest_point_by_newton(*shape, p);
      ASSERT_TRUE(newton.converged) << p.transpose();
      EXPECT_NEAR((newton.point - closest_point(*shape, p).point).norm(), 0, 1e-9) << p.transpose();
    }
  }
}

/// The closest point of an ellipsoid from the outside or near it: q_i = a_i^2 p_i / (a_i^2 + t), t
/// the largest root of sum (a_i p_i / (a_i^2 + t))^2 = 1, found by bisection.
Vec3 closest_on_ellipsoid(const Vec3& a, const Vec3& p) {
  const Vec3 aa = a.cwiseAbs2();
  const auto excess = [&](double t) {
    return (a.array() * p.array() / (aa.array() + t)).square().sum() - 1.;
  };
  double low = -aa.minCoeff();
  double high = 10. * (p.norm() + 1.) * a.maxCoeff() + 1.;
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (low + high);
    (excess(middle) > 0 ? low : high) = middle;
  }
  return aa.array() * p.array() / (aa.array() + high);
}

TEST(ClosestPoint, EllipsoidAgreesWithTheSecularEquation) {
  const Ellipsoid shape(Vec3(1., 0.8, 0.6));
  for (const Vec3& p : points_near(shape, 1000, 0.25, 2)) {
    const ClosestPoint closest = closest_point(shape, p);
    ASSERT_TRUE(closest.converged) << p.transpose();
    EXPECT_NEAR((closest.point - closest_on_ellipsoid(shape.semi_axes(), p)).norm(), 0, 1e-9);
  }
}

TEST(ClosestPoint, NoSampleOfTheSurfaceIsCloser) {
  for (const char* spec : {"ellipsoid", "torus", "rounded-cube", "goursat", "leopold",
                           "expr:x^2+2*y^2+z^4-1;box=-1.3,1.3"}) {
    SCOPED_TRACE(spec);
    const auto shape = make_shape(spec);
    const double size = shape->bounds().diagonal().norm();
    const std::vector<Vec3> samples = points_near(*shape, 4000, 0., 3);
    for (const Vec3& p : points_near(*shape, 200, 0.01 * size, 4)) {
      const ClosestPoint closest = closest_point_by_newton(*shape, p);
      ASSERT_TRUE(closest.converged) << p.transpose();
      const double distance = (closest.point - p).norm();
      for (const Vec3& s : samples) ASSERT_GE((s - p).norm(), distance - 1e-9 * size);
      // Independent of the solver: on the surface (the sign changes across), and p - q is normal.
      const Vec3 n = shape->gradient(closest.point).normalized();
      EXPECT_LT(shape->value(closest.point - 1e-7 * size * n), 0);
      EXPECT_GT(shape->value(closest.point + 1e-7 * size * n), 0);
      EXPECT_LT(n.cross(p - closest.point).norm(), 1e-8 * size);
    }
  }
}

TEST(ClosestPoint, CentresHaveSomeClosestPoint) {
  EXPECT_DOUBLE_EQ(closest_point(Sphere(2.), Vec3::Zero()).point.norm(), 2.);
  const ClosestPoint centre = closest_point(Ellipsoid(), Vec3::Zero());
  ASSERT_TRUE(centre.converged);
  EXPECT_NEAR(centre.point.norm(), 0.6, 1e-9);  // the smallest semi-axis
  EXPECT_NEAR((closest_point(Torus(1., 0.4), Vec3(0, 0, 0.)).point).norm(), 0.6, 1e-12);
}

TEST(ClosestPoint, AShapeWithoutSurfaceFails) {
  const auto shape = make_shape("expr:x^2+y^2+z^2+1;box=-1,1");
  EXPECT_FALSE(closest_point(*shape, Vec3(0.3, 0.2, 0.1)).converged);
  const double points[] = {0.3, 0.2, 0.1, 0., 0., 0.};
  EXPECT_EQ(project_points(*shape, {points, 2}).failures, 2);
}

TEST(ClosestPoint, PointsThatAreNotNumbersAreRefused) {
  EXPECT_THROW(closest_point(Sphere(), Vec3(0, std::nan(""), 0)), InputError);
}

TEST(ProjectPoints, ManyAreProjectedAsOneWhateverTheThreads) {
  const Ellipsoid shape;
  const std::vector<Vec3> points = points_near(shape, 3000, 0.1, 5);
  const Vec3View view{points.front().data(), static_cast<Index>(points.size())};
  const ProjectedPoints one = project_points(shape, view, Context{1});
  const ProjectedPoints many = project_points(shape, view, Context{4});
  EXPECT_EQ(one.failures, 0);
  EXPECT_EQ(one.points, many.points);
  EXPECT_EQ(one.points.col(17), closest_point(shape, points[17]).point);
}

}  // namespace
}  // namespace dsc
