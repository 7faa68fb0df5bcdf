#include "libdsc/truth/smooth_mesh.h"

#include "libdsc/base/error.h"
#include "libdsc/truth/digital_topology.h"
#include "libdsc/voxels/shape_spec.h"
#include "libdsc/voxels/shapes.h"
#include "tests/truth/shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dsc::truth {
namespace {

using test::kPi;

struct Known {
  std::string shape;
  double edge;
  Index components;
  Index euler;
};

/// Two spheres, of radius 1 and 0.2; a ball with a hole; a shape as thin as an edge is long.
const Known kKnown[] = {
    {"sphere,cx=0.3", 0.1, 1, 2},
    {"ellipsoid", 0.1, 1, 2},
    {"torus", 0.1, 1, 0},
    {"torus,R=1,r=0.1", 0.1, 1, 0},
    {"rounded-cube", 0.1, 1, 2},
    {"goursat", 1., 1, 2},
    {"leopold", 0.4, 1, 2},
    {"ellipsoid,a=1,b=0.8,c=0.05", 0.1, 1, 2},
    {"expr:(x^2+y^2+z^2-1)*((x-3)^2+y^2+z^2-0.04);box=-1.2,-1.2,-1.2,3.4,1.2,1.2", 0.2, 2, 4},
    {"expr:(x^2+y^2+z^2-1)*(x^2+y^2+z^2-0.25);box=-1.1,1.1", 0.1, 2, 4}};

TEST(SmoothMesh, IsTheWholeClosedSurfaceOfEveryShape) {
  for (const Known& known : kKnown) {
    const auto shape = make_shape(known.shape);
    const SmoothMesh result = smooth_mesh(*shape, {known.edge});
    const TriangleMeshCounts counts = count(result.mesh);
    EXPECT_TRUE(counts.closed_manifold()) << known.shape;
    EXPECT_EQ(counts.components, known.components) << known.shape;
    EXPECT_EQ(counts.euler, known.euler) << known.shape;
    EXPECT_LE(edge_lengths(result.mesh).longest, 1.25 * known.edge) << known.shape;
  }
}

TEST(SmoothMesh, EveryVertexIsOnTheSurfaceToRounding) {
  for (const Known& known : kKnown) {
    const auto shape = make_shape(known.shape);
    const SmoothMesh result = smooth_mesh(*shape, {known.edge});
    const double size = shape->bounds().diagonal().norm();
    for (Index v = 0; v < result.mesh.vertex_count(); ++v) {
      const Vec3 p = result.mesh.vertices.col(v);
      ASSERT_LE(std::abs(shape->value(p)), 1e-12 * size * shape->gradient(p).norm())
          << known.shape << " at " << p.transpose();
    }
  }
}

TEST(SmoothMesh, TrianglesFaceOutwards) {
  for (const Known& known : kKnown) {
    const auto shape = make_shape(known.shape);
    const SmoothMesh result = smooth_mesh(*shape, {known.edge});
    for (Index f = 0; f < result.mesh.face_count(); ++f) {
      for (int k = 0; k < 3; ++k) {
        const Vec3 g = shape->gradient(result.mesh.corner(f, k));
        ASSERT_GT(result.mesh.area_vector(f).dot(g), 0.) << known.shape;
      }
    }
  }
}

TEST(SmoothMesh, AreaAndVolumeConvergeWithTheSquareOfTheEdge) {
  const Torus torus(1., 0.4);
  const double area = 4. * kPi * kPi * 0.4;
  const double volume = 2. * kPi * kPi * 0.16;
  SmoothMesh mesh = smooth_mesh(torus, {0.2});
  double area_error = area - test::area_of(mesh.mesh);
  double volume_error = volume - test::volume_of(mesh.mesh);
  for (int k = 0; k < 3; ++k) {
    mesh = refine(torus, mesh);
    const double area_next = area - test::area_of(mesh.mesh);
    const double volume_next = volume - test::volume_of(mesh.mesh);
    EXPECT_NEAR(area_error / area_next, 4., 0.4);
    EXPECT_NEAR(volume_error / volume_next, 4., 0.4);
    area_error = area_next;
    volume_error = volume_next;
  }
}

TEST(SmoothMesh, RefinedHasTheCoarseVertices) {
  const Ellipsoid shape;
  const SmoothMesh coarse = smooth_mesh(shape, {0.2});
  const SmoothMesh fine = refine(shape, coarse);
  EXPECT_EQ(fine.counts.faces, 4 * coarse.counts.faces);
  EXPECT_EQ(fine.mesh.vertices.leftCols(coarse.mesh.vertex_count()), coarse.mesh.vertices);
}

TEST(SmoothMesh, CavitiesFaceTheirInside) {
  const auto shell = make_shape("expr:(x^2+y^2+z^2-1)*(x^2+y^2+z^2-0.25);box=-1.1,1.1");
  const SmoothMesh result = smooth_mesh(*shell, {0.05});
  EXPECT_NEAR(test::volume_of(result.mesh), 4. / 3. * kPi * (1. - 0.125), 0.01);
}

TEST(SmoothMesh, RefusesWhatHasNoClosedSmoothSurface) {
  EXPECT_THROW(smooth_mesh(Plane(), {0.1}), UsageError);
  EXPECT_THROW(smooth_mesh(Sphere(), {0.}), UsageError);
  EXPECT_THROW(smooth_mesh(Sphere(), {std::nan("")}), UsageError);
  EXPECT_THROW(smooth_mesh(Sphere(), {0.01, 1000}), LimitError);
  EXPECT_THROW(smooth_mesh(*make_shape("expr:x^2+y^2+z^2-1;box=-1.1,-1.1,-1.1,0.5,1.1,1.1"), {0.1}),
               InputError);
  EXPECT_THROW(smooth_mesh(*make_shape("expr:1+x^2;box=-1,1"), {0.1}), InputError);
}

TEST(DigitalTopology, EulerNumberOfVoxels) {
  const auto euler = [](const std::vector<Index3>& voxels) {
    Grid grid;
    grid.size = {5, 5, 5};
    BinaryVolume volume(grid);
    for (const Index3& v : voxels) volume.set(v[0], v[1], v[2]);
    return surface_euler_number(volume);
  };
  EXPECT_EQ(euler({}), 0);
  EXPECT_EQ(euler({{0, 0, 0}}), 2);
  EXPECT_EQ(euler({{4, 4, 4}, {4, 4, 3}}), 2);
  EXPECT_EQ(euler({{1, 1, 1}, {2, 2, 1}}), 4);  // 6-connected: apart
  std::vector<Index3> ring;
  std::vector<Index3> shell;
  for (Index z = 0; z < 3; ++z) {
    for (Index y = 0; y < 3; ++y) {
      for (Index x = 0; x < 3; ++x) {
        if (z == 0 && (x != 1 || y != 1)) ring.push_back({x, y, z});
        if (x != 1 || y != 1 || z != 1) shell.push_back({x, y, z});
      }
    }
  }
  EXPECT_EQ(euler(ring), 0);
  EXPECT_EQ(euler(shell), 4);
  shell.push_back({1, 1, 1});
  EXPECT_EQ(euler(shell), 2);
}

}  // namespace
}  // namespace dsc::truth
