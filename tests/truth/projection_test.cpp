#include "libdsc/truth/projection.h"

#include "libdsc/base/error.h"
#include "libdsc/truth/smooth_mesh.h"
#include "libdsc/truth/true_geometry.h"
#include "libdsc/voxels/shapes.h"
#include "tests/truth/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dsc::truth {
namespace {

using test::kPi;

/// The distance of p from a segment and from a triangle, by cases.
double to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0., 1.);
  return (a + t * (b - a) - p).norm();
}

double to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = (b - a).cross(c - a).normalized();
  const Vec3 q = p - n * n.dot(p - a);
  const bool inside = (b - a).cross(q - a).dot(n) >= 0 && (c - b).cross(q - b).dot(n) >= 0 &&
                      (a - c).cross(q - c).dot(n) >= 0;
  if (inside) return (p - q).norm();
  return std::min({to_segment(p, a, b), to_segment(p, b, c), to_segment(p, c, a)});
}

double brute_force(const TriangleMesh& mesh, const Vec3& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (Index f = 0; f < mesh.face_count(); ++f) {
    nearest =
        std::min(nearest, to_triangle(p, mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2)));
  }
  return nearest;
}

TEST(MeshTree, FindsTheClosestPointOfAllTriangles) {
  const Torus shape(1., 0.4);
  const TriangleMesh mesh = smooth_mesh(shape, {0.2}).mesh;
  const MeshTree tree(mesh);
  const Eigen::Matrix3Xd points = test::random_points(shape, 200, 1.5);
  for (Index i = 0; i < points.cols(); ++i) {
    const Vec3 p = points.col(i);
    const MeshPoint found = tree.closest(p);
    ASSERT_NEAR((found.point - p).norm(), brute_force(mesh, p), 1e-12);
    // What it says of the point agrees with where it is.
    EXPECT_GE(found.barycentric.minCoeff(), 0.);
    EXPECT_NEAR(found.barycentric.sum(), 1., 1e-15);
    Vec3 q = Vec3::Zero();
    for (int k = 0; k < 3; ++k) q += found.barycentric[k] * mesh.corner(found.face, k);
    EXPECT_LE((q - found.point).norm(), 1e-14);
  }
}

TEST(MeshTree, LeavesOutTrianglesWithoutArea) {
  TriangleMesh mesh = test::tetrahedron();
  mesh.faces.insert(mesh.faces.begin(), Triangle{0, 0, 1});
  const MeshPoint found = MeshTree(mesh).closest(Vec3(0.2, 0.2, -1.));
  EXPECT_EQ(found.face, 1);
  EXPECT_LE((found.point - Vec3(0.2, 0.2, 0.)).norm(), 1e-15);
  mesh.faces.resize(1);
  EXPECT_THROW(MeshTree{mesh}, InputError);
  EXPECT_THROW(MeshTree(test::tetrahedron()).closest(Vec3(0., std::nan(""), 0.)), InputError);
}

/// The pointels of a digitization against closed forms, which the projection does not use.
void expect_closed_form(const ImplicitShape& shape, double h) {
  const DigitalSurface surface = test::digital_surface(shape, h);
  const SurfaceProjection projection(shape, smooth_mesh(shape, {0.1}).mesh);
  const ProjectedPoints projected = projection.project(surface.positions());
  EXPECT_EQ(projected.failures, 0);
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    const Vec3 p = surface.position(static_cast<VertexId>(v));
    ASSERT_LE((projected.points.col(v) - *shape.closest_point_in_closed_form(p)).norm(), 1e-11);
  }
}

TEST(SurfaceProjection, OfPointelsIsTheClosedForm) {
  expect_closed_form(Sphere(1., Vec3(0.1, 0.2, 0.3)), 0.05);
  expect_closed_form(Torus(1., 0.4), 0.05);
}

TEST(SurfaceProjection, SatisfiesTheConditionsOnGoursat) {
  const Goursat shape;
  const DigitalSurface surface = test::digital_surface(shape, 0.5);
  const SurfaceProjection projection(shape, smooth_mesh(shape, {0.5}).mesh);
  const ProjectedPoints projected = projection.project(surface.positions());
  EXPECT_EQ(projected.failures, 0);
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    const Vec3 p = surface.position(static_cast<VertexId>(v));
    const Vec3 q = projected.points.col(v);
    const Vec3 g = shape.gradient(q);
    ASSERT_LE(std::abs(shape.value(q)) / g.norm(), 1e-12 * 35.);
    ASSERT_LE((q - p).cross(g).norm() / g.norm(), 1e-9 * 35.);
    ASSERT_LE((q - p).norm(), 0.5 * std::sqrt(3.));
  }
}

// Points anywhere in a thin body, and far from it: Newton from the point itself often ends on the
// wrong side or at a bulge. A mesh, every vertex on the surface, tells how near the surface is.
TEST(SurfaceProjection, FindsTheBranchThatNewtonAloneMisses) {
  const Ellipsoid shape(Vec3(1., 0.9, 0.15));
  const TriangleMesh mesh = refine(shape, smooth_mesh(shape, {0.05})).mesh;
  const SurfaceProjection projection(shape, mesh);
  const Eigen::Matrix3Xd points = test::random_points(shape, 150);
  const double sagitta = 1e-3;  // between the mesh and the surface, at the rim
  Index missed = 0;
  for (Index i = 0; i < points.cols(); ++i) {
    const Vec3 p = points.col(i);
    const double nearest = brute_force(mesh, p);
    const ClosestPoint alone = closest_point_by_newton(shape, p);
    if (!alone.converged || (alone.point - p).norm() > nearest + sagitta) ++missed;
    const ClosestPoint found = projection.closest(p);
    ASSERT_TRUE(found.converged) << p.transpose();
    EXPECT_LE((found.point - p).norm(), nearest + sagitta) << p.transpose();
  }
  EXPECT_GT(missed, 0);  // or this test shows nothing
}

TEST(SurfaceProjection, PointsWithoutAUniqueAnswerGetOne) {
  const Sphere sphere(2.);
  const SurfaceProjection projection(sphere, smooth_mesh(sphere, {0.5}).mesh);
  const ClosestPoint centre = projection.closest(Vec3::Zero());
  EXPECT_TRUE(centre.converged);
  EXPECT_NEAR(centre.point.norm(), 2., 1e-12);
  EXPECT_THROW(projection.closest(Vec3(0., 0., std::nan(""))), InputError);
}

TEST(TrueGeometry, OfAnEllipsoidIsItsClosedForm) {
  const Vec3 axes(1., 0.8, 0.6);
  const Ellipsoid shape(axes);
  const DigitalSurface surface = test::digital_surface(shape, 0.1);
  const SurfaceProjection projection(shape, smooth_mesh(shape, {0.1}).mesh);
  const ProjectedPoints projected = projection.project(surface.positions());
  const TrueGeometry geometry = true_geometry(shape, test::view(projected.points));
  EXPECT_EQ(geometry.failures, 0);
  const Vec3 w = axes.cwiseAbs2().cwiseInverse();
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    const Vec3 q = projected.points.col(v);
    const double s = w.cwiseAbs2().dot(q.cwiseAbs2());  // sum of x^2 / a^4
    const double abc2 = axes.cwiseAbs2().prod();
    // Of x^2/a^2 + y^2/b^2 + z^2/c^2 = 1, the classical formulas.
    const double gaussian = 1. / (abc2 * s * s);
    const double mean = (axes.squaredNorm() - q.squaredNorm()) / (2. * abc2 * std::pow(s, 1.5));
    ASSERT_NEAR(geometry.gaussian[v], gaussian, 1e-10);
    ASSERT_NEAR(geometry.mean[v], mean, 1e-10);
    const Vec3 normal = w.cwiseProduct(q).normalized();
    ASSERT_LE((geometry.normals.col(v) - normal).norm(), 1e-12);
  }
}

TEST(TrueGeometry, PointsWithoutATangentPlaneAreCounted) {
  Eigen::Matrix3Xd points(3, 2);
  points << 0, 1, 0, 0, 0, 0;
  const TrueGeometry geometry = true_geometry(Sphere(), test::view(points));
  EXPECT_EQ(geometry.failures, 1);
  EXPECT_TRUE(geometry.normals.allFinite());
  EXPECT_EQ(geometry.mean[0], 0.);
  EXPECT_NEAR(geometry.mean[1], 1., 1e-15);
}

}  // namespace
}  // namespace dsc::truth
