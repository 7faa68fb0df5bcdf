#include "libdsc/truth/exact_geodesic.h"

#include "libdsc/base/error.h"
#include "libdsc/truth/smooth_mesh.h"
#include "libdsc/voxels/shapes.h"
#include "tests/truth/shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dsc::truth {
namespace {

using test::kPi;
using test::view;

/// The unit cube, each side cut into two triangles.
TriangleMesh cube() {
  TriangleMesh mesh;
  mesh.vertices.resize(3, 8);
  for (int v = 0; v < 8; ++v) mesh.vertices.col(v) = Vec3(v & 1, v >> 1 & 1, v >> 2 & 1);
  mesh.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TEST(ExactGeodesic, OnACubeIsTheUnfoldedStraightLine) {
  ASSERT_TRUE(count(cube()).closed_manifold());
  const ExactGeodesic geodesic(cube());
  Eigen::Matrix3Xd queries(3, 6);
  queries << 1, 1, 0, 0.5, 0.5, 0.25,  //
      0, 1, 0, 0.5, 0, 0.25,           //
      0, 1, 0, 1, 0.5, 0.;
  const Eigen::VectorXd corner = geodesic.distances(Vec3::Zero(), view(queries));
  EXPECT_NEAR(corner[0], 1., 1e-12);
  EXPECT_NEAR(corner[1], std::sqrt(5.), 1e-12);  // over two sides
  EXPECT_EQ(corner[2], 0.);
  EXPECT_NEAR(corner[3], std::hypot(1.5, 0.5), 1e-12);
  EXPECT_NEAR(corner[4], std::hypot(0.5, 0.5), 1e-12);
  EXPECT_NEAR(corner[5], std::hypot(0.25, 0.25), 1e-12);

  // From a point within a side; the first two, from the centre of one to the opposite one and back.
  EXPECT_NEAR(geodesic.distances(Vec3(0.5, 0.5, 0.), view(queries))[3], 2., 1e-12);
  EXPECT_NEAR(geodesic.distances(Vec3(0.5, 0.5, 1.), view(queries))[1], std::hypot(0.5, 0.5),
              1e-12);
}

// Points outside land on edges and at vertices of the mesh, points inside within triangles.
TEST(ExactGeodesic, IsAMetric) {
  const Ellipsoid shape;
  const TriangleMesh mesh = smooth_mesh(shape, {0.3}).mesh;
  const ExactGeodesic geodesic(mesh);
  const Index n = 30;
  Eigen::Matrix3Xd points = test::random_points(shape, n, 1.3);
  points.col(0) = mesh.vertices.col(7);
  points.col(1) = 0.7 * mesh.corner(5, 0) + 0.3 * mesh.corner(5, 1);
  points.col(2) = 0.2 * mesh.corner(5, 0) + 0.8 * mesh.corner(5, 1);
  points.col(3) = 0.2 * mesh.corner(5, 0) + 0.8 * mesh.corner(5, 2);
  Eigen::MatrixXd d(n, n);
  for (Index i = 0; i < n; ++i) d.col(i) = geodesic.distances(points.col(i), view(points));
  EXPECT_LE((d - d.transpose()).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LE(d.diagonal().maxCoeff(), 1e-12);
  EXPECT_NEAR(d(1, 2), (points.col(1) - points.col(2)).norm(), 1e-12);
  EXPECT_NEAR(d(1, 3), (points.col(1) - points.col(3)).norm(), 1e-12);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      ASSERT_LE(d(i, j), (d.col(i) + d.col(j)).minCoeff() + 1e-10);
    }
  }
}

TEST(ExactGeodesic, OtherComponentsAreInfinitelyFar) {
  TriangleMesh mesh = cube();
  const TriangleMesh other = test::tetrahedron();
  mesh.vertices.conservativeResize(3, 12);
  mesh.vertices.rightCols(4) = other.vertices.array() + 3.;
  for (Triangle t : other.faces) mesh.faces.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  Eigen::Matrix3Xd queries(3, 2);
  queries.col(0) = Vec3(1., 0., 0.);
  queries.col(1) = Vec3(4., 3., 3.);
  const ExactGeodesic geodesic(mesh);
  EXPECT_EQ(geodesic.distances(Vec3::Zero(), view(queries))[1],
            std::numeric_limits<double>::infinity());
  EXPECT_EQ(geodesic.distances(Vec3(3., 3., 3.), view(queries))[0],
            std::numeric_limits<double>::infinity());
  EXPECT_NEAR(geodesic.distances(Vec3(3., 3., 3.), view(queries))[1], 1., 1e-12);
}

TEST(ExactGeodesic, RefusesTooLargeAndTangledMeshes) {
  TriangleMesh large;
  large.vertices = Eigen::Matrix3Xd::Random(3, kMaxGeodesicVertices + 1);
  large.faces = {{0, 1, 2}};
  EXPECT_THROW(ExactGeodesic{large}, LimitError);
  TriangleMesh tangled = cube();
  std::swap(tangled.faces[0][0], tangled.faces[0][1]);
  EXPECT_THROW(ExactGeodesic{tangled}, InputError);
  EXPECT_THROW(surface_distances(Sphere(), 0.005, Vec3::UnitX(), {}), LimitError);
}

double great_circle(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

TEST(SurfaceDistances, OnTheSphereTendToTheGreatCircle) {
  const Sphere sphere;
  Eigen::Matrix3Xd points = test::random_points(sphere, 500);
  points.colwise().normalize();
  const Vec3 source = Vec3(1., 2., 3.).normalized();
  double previous_mean = 0;
  for (const double edge : {0.4, 0.2}) {
    const SurfaceDistances d = surface_distances(sphere, edge, source, view(points));
    double coarse = 0, fine = 0, worst = 0, mean = 0;
    for (Index i = 0; i < points.cols(); ++i) {
      const double truth = great_circle(source, points.col(i));
      coarse = std::max(coarse, std::abs(d.coarse[i] - truth));
      fine = std::max(fine, std::abs(d.fine[i] - truth));
      worst = std::max(worst, std::abs(d.distance[i] - truth));
      mean += std::abs(d.distance[i] - truth) / static_cast<double>(points.cols());
    }
    EXPECT_NEAR(coarse / fine, 4., 0.8);  // second order
    EXPECT_LT(worst, fine / 2.);
    EXPECT_LT(mean, fine / 10.);
    // What it reports of itself is the fine mesh's error.
    EXPECT_NEAR(d.correction, fine, 0.5 * fine);
    if (previous_mean > 0) {
      EXPECT_GT(previous_mean / mean, 4.);  // better than second order
    }
    previous_mean = mean;
  }
}

TEST(SurfaceDistances, AlongATorusInnerCircleAreItsArcs) {
  // No path around the axis by an angle is shorter than along the circle nearest to it.
  const Torus torus(1., 0.4);
  const Vec3 source = 0.6 * Vec3(std::cos(0.3), std::sin(0.3), 0.);
  Eigen::Matrix3Xd points(3, 40);
  for (Index i = 0; i < points.cols(); ++i) {
    const double angle = 0.3 + kPi * static_cast<double>(i) / 39.;
    points.col(i) = 0.6 * Vec3(std::cos(angle), std::sin(angle), 0.);
  }
  const SurfaceDistances d = surface_distances(torus, 0.2, source, view(points));
  for (Index i = 0; i < points.cols(); ++i) {
    EXPECT_NEAR(d.distance[i], 0.6 * kPi * static_cast<double>(i) / 39., 1e-3);
  }
}

TEST(SurfaceDistances, FromThePoleOfASpheroidAreItsMeridians) {
  const double a = 1., c = 0.6;
  const Ellipsoid spheroid(Vec3(a, a, c));
  Eigen::Matrix3Xd points(3, 20);
  Eigen::VectorXd truth(20);
  for (Index i = 0; i < 20; ++i) {
    const double t = kPi * static_cast<double>(i + 1) / 21.;
    points.col(i) = Vec3(a * std::sin(t) * std::cos(2. * static_cast<double>(i)),
                         a * std::sin(t) * std::sin(2. * static_cast<double>(i)), c * std::cos(t));
    truth[i] = 0;  // the arc of the ellipse, by the midpoint rule
    for (int k = 0; k < 2000; ++k) {
      const double s = t * (k + 0.5) / 2000.;
      truth[i] += t / 2000. * std::hypot(a * std::cos(s), c * std::sin(s));
    }
  }
  const SurfaceDistances d = surface_distances(spheroid, 0.2, Vec3(0., 0., c), view(points));
  EXPECT_LE((d.distance - truth).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_LE((d.distance - truth).cwiseAbs().mean(), 2e-4);
}

}  // namespace
}  // namespace dsc::truth
