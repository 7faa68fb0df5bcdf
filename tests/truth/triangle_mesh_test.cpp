#include "libdsc/truth/triangle_mesh.h"

#include "libdsc/base/error.h"
#include "tests/truth/shapes.h"

#include <gtest/gtest.h>

namespace dsc::truth {
namespace {

using test::tetrahedron;

/// Two tetrahedra; vertices `shared` of the second are those of the first.
TriangleMesh two_tetrahedra(const std::vector<VertexId>& shared) {
  TriangleMesh mesh = tetrahedron();
  const TriangleMesh other = tetrahedron();
  std::vector<VertexId> number(4);
  mesh.vertices.conservativeResize(3, 8 - static_cast<Index>(shared.size()));
  VertexId next = 4;
  for (VertexId v = 0; v < 4; ++v) {
    const bool is_shared = static_cast<std::size_t>(v) < shared.size();
    number[static_cast<std::size_t>(v)] = is_shared ? shared[static_cast<std::size_t>(v)] : next++;
    if (!is_shared) {
      mesh.vertices.col(number[static_cast<std::size_t>(v)]) =
          other.vertices.col(v) + Vec3::Constant(2.);
    }
  }
  for (Triangle t : other.faces) {
    for (VertexId& v : t) v = number[static_cast<std::size_t>(v)];
    mesh.faces.push_back(t);
  }
  return mesh;
}

TEST(TriangleMesh, CountsOfATetrahedron) {
  const TriangleMeshCounts counts = count(tetrahedron());
  EXPECT_TRUE(counts.closed_manifold());
  EXPECT_EQ(counts.vertices, 4);
  EXPECT_EQ(counts.edges, 6);
  EXPECT_EQ(counts.euler, 2);
  EXPECT_EQ(counts.components, 1);
}

TEST(TriangleMesh, EveryDefectIsCounted) {
  TriangleMesh open = tetrahedron();
  open.faces.pop_back();
  EXPECT_EQ(count(open).boundary_edges, 3);
  EXPECT_FALSE(count(open).closed_manifold());

  TriangleMesh turned = tetrahedron();
  std::swap(turned.faces[2][0], turned.faces[2][1]);
  EXPECT_EQ(count(turned).misoriented_edges, 3);
  EXPECT_FALSE(count(turned).closed_manifold());

  EXPECT_EQ(count(two_tetrahedra({})).components, 2);
  EXPECT_TRUE(count(two_tetrahedra({})).closed_manifold());
  const TriangleMeshCounts touching = count(two_tetrahedra({3}));
  EXPECT_EQ(touching.pinched_vertices, 1);
  EXPECT_EQ(touching.components, 1);
  EXPECT_FALSE(touching.closed_manifold());
  EXPECT_EQ(count(two_tetrahedra({0, 1})).nonmanifold_edges, 1);
  EXPECT_FALSE(count(two_tetrahedra({0, 1})).closed_manifold());

  TriangleMesh unused = tetrahedron();
  unused.vertices.conservativeResize(3, 5);
  unused.vertices.col(4).setOnes();
  EXPECT_EQ(count(unused).unused_vertices, 1);
  EXPECT_FALSE(count(unused).closed_manifold());

  TriangleMesh wrong = tetrahedron();
  wrong.faces[1][2] = 4;
  EXPECT_THROW(count(wrong), InputError);
}

TEST(TriangleMesh, OrientTurnsWhatWasTurned) {
  TriangleMesh mesh = two_tetrahedra({});
  std::mt19937 random(3);
  for (Triangle& t : mesh.faces) {
    if (random() % 2 == 0) std::swap(t[1], t[2]);
  }
  ASSERT_GT(count(mesh).misoriented_edges, 0);
  const Vec3 centres[2] = {Vec3::Constant(0.25), Vec3::Constant(2.25)};
  orient(mesh, [&](const Vec3& p) {
    return (p - centres[0]).norm() < (p - centres[1]).norm() ? Vec3(p - centres[0])
                                                             : Vec3(p - centres[1]);
  });
  EXPECT_TRUE(count(mesh).closed_manifold());
  EXPECT_NEAR(test::volume_of(mesh), 2. / 6., 1e-15);
}

TEST(TriangleMesh, SubdivisionKeepsTheSurface) {
  const TriangleMesh fine = subdivide(subdivide(tetrahedron()));
  const TriangleMeshCounts counts = count(fine);
  EXPECT_TRUE(counts.closed_manifold());
  EXPECT_EQ(counts.faces, 64);
  EXPECT_EQ(counts.euler, 2);
  EXPECT_EQ(fine.vertices.leftCols(4), tetrahedron().vertices);
  EXPECT_NEAR(test::volume_of(fine), 1. / 6., 1e-15);
  EXPECT_NEAR(test::area_of(fine), test::area_of(tetrahedron()), 1e-14);
  EXPECT_NEAR(edge_lengths(fine).longest, std::sqrt(2.) / 4., 1e-15);
}

}  // namespace
}  // namespace dsc::truth
