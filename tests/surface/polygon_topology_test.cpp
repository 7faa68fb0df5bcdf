// Counts of polygon meshes whose topology is known, and their OpenMesh form.
#include "libdsc/surface/polygon_topology.h"

#include "libdsc/surface/extract.h"
#include "libdsc/surface/split_mesh.h"
#include "tests/support/random_volume.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

namespace dsc {
namespace {

/// Polygons over n points; where the points lie does not matter.
struct Polygons {
  Eigen::Matrix3Xd positions;
  std::vector<VertexId> corners;
  std::vector<Index> offsets{0};

  Polygons(Index n, const std::vector<std::vector<VertexId>>& faces)
      : positions(Eigen::Matrix3Xd::Random(3, n)) {
    for (const auto& face : faces) {
      corners.insert(corners.end(), face.begin(), face.end());
      offsets.push_back(std::ssize(corners));
    }
  }
  FlatMesh view() const {
    FlatMesh mesh;
    mesh.positions = {positions.data(), positions.cols()};
    mesh.corners = corners;
    mesh.offsets = offsets;
    return mesh;
  }
};

TEST(PolygonTopology, ATetrahedronIsASphere) {
  const Polygons p(4, {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}});
  const SurfaceCounts c = count_polygons(p.view());
  EXPECT_EQ(c.edges, 6);
  EXPECT_EQ(c.euler, 2);
  EXPECT_EQ(c.components, 1);
  EXPECT_EQ(c.boundary_edges + c.nonmanifold_edges + c.pinched_vertices, 0);
}

TEST(PolygonTopology, AMoebiusBandHasOneBoundaryAndNoPinch) {
  // Five quads around, the last one glued with a twist; no orientation is asked for.
  std::vector<std::vector<VertexId>> faces;
  for (VertexId i = 0; i < 4; ++i) faces.push_back({2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
  faces.push_back({8, 1, 0, 9});
  const SurfaceCounts c = count_polygons(Polygons(10, faces).view());
  EXPECT_EQ(c.euler, 0);
  EXPECT_EQ(c.boundary_edges, 10);
  EXPECT_EQ(c.pinched_vertices, 0);
}

TEST(PolygonTopology, ThreePagesMeetAtOneEdge) {
  const Polygons p(6, {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}});
  const SurfaceCounts c = count_polygons(p.view());
  EXPECT_EQ(c.edges, 7);
  EXPECT_EQ(c.nonmanifold_edges, 1);
  EXPECT_EQ(c.boundary_edges, 6);
  EXPECT_EQ(c.pinched_vertices, 2);
  EXPECT_EQ(c.components, 2) << "the vertex without a face is one";
  EXPECT_EQ(count_isolated_vertices(p.view()), 1);
}

TEST(PolygonTopology, SidesAreLinkedInPairsOnly) {
  using Links = std::vector<VertexId>;
  const Polygons pages(5, {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}});
  EXPECT_EQ(linked_sides(pages.view(), SideLinks::any), Links(9, -1));
  const Polygons opposed(4, {{0, 1, 2}, {1, 0, 3}});
  EXPECT_EQ(linked_sides(opposed.view(), SideLinks::opposed), (Links{3, -1, -1, 0, -1, -1}));
  const Polygons alike(4, {{0, 1, 2}, {0, 1, 3}});
  EXPECT_EQ(linked_sides(alike.view(), SideLinks::any), (Links{3, -1, -1, 0, -1, -1}));
  EXPECT_EQ(linked_sides(alike.view(), SideLinks::opposed), Links(6, -1));
}

TEST(PolygonTopology, TwoFansAtOneVertexPinchIt) {
  const Polygons p(5, {{0, 1, 2}, {0, 3, 4}});
  const SurfaceCounts c = count_polygons(p.view());
  EXPECT_EQ(c.pinched_vertices, 1);
  EXPECT_EQ(c.components, 1);
}

TEST(PolygonTopology, DigitalSurfacesHaveTheCountsOfTheirExtraction) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const DigitalSurface surface = extract_surface(testing::random_volume({6, 5, 7}, 0.4, seed));
    const SurfaceCounts expected = surface.counts();
    const SurfaceCounts c = count_polygons(surface.flat());
    EXPECT_EQ(c.vertices, expected.vertices);
    EXPECT_EQ(c.edges, expected.edges);
    EXPECT_EQ(c.faces, expected.faces);
    EXPECT_EQ(c.euler, expected.euler);
    EXPECT_EQ(c.components, expected.components);
    EXPECT_EQ(c.boundary_edges, expected.boundary_edges);
    EXPECT_EQ(c.nonmanifold_edges, expected.nonmanifold_edges);
  }
}

TEST(PolygonTopology, ACornerThatIsNoVertexIsRefused) {
  EXPECT_THROW((void)count_polygons(Polygons(2, {{0, 1, 2}}).view()), InputError);
}

/// The mesh has every face, in order, with its own corners up to copies.
void expect_split(const Polygons& polygons) {
  SurfaceMesh mesh;
  const FlatMesh flat = polygons.view();
  const std::vector<VertexId> copied = split_mesh(flat, mesh);
  ASSERT_EQ(mesh.n_vertices(), copied.size());
  ASSERT_EQ(static_cast<Index>(mesh.n_faces()), flat.faces());
  for (Index v = 0; v < flat.vertices(); ++v) EXPECT_EQ(copied[static_cast<std::size_t>(v)], v);
  for (std::size_t v = 0; v < copied.size(); ++v) {
    const auto& p = mesh.point(OpenMesh::VertexHandle(static_cast<int>(v)));
    EXPECT_EQ(Vec3(p[0], p[1], p[2]), flat.positions[copied[v]]);
  }
  for (Index f = 0; f < flat.faces(); ++f) {
    std::vector<VertexId> ids;
    for (const auto v : mesh.fv_range(OpenMesh::FaceHandle(static_cast<int>(f)))) {
      ids.push_back(copied[static_cast<std::size_t>(v.idx())]);
    }
    const auto face = flat.face(f);
    EXPECT_EQ(ids, std::vector<VertexId>(face.begin(), face.end()));
  }
}

TEST(SplitMesh, AManifoldStaysWhole) {
  const Polygons p(4, {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}});
  SurfaceMesh mesh;
  EXPECT_EQ(split_mesh(p.view(), mesh).size(), 4U);
  EXPECT_EQ(mesh.n_edges(), 6U);
}

TEST(SplitMesh, AnyPolygonsBecomeAHalfedgeMesh) {
  expect_split(Polygons(6, {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}}));
  expect_split(Polygons(3, {{0, 1, 2}, {0, 1, 2}, {2, 1, 0}, {0, 0, 0}}));
  expect_split(Polygons(5, {{0, 1, 0, 2}, {0, 1, 2, 0, 3, 4}}));
  std::mt19937 random(1);
  for (int round = 0; round < 300; ++round) {
    const int n = 3 + static_cast<int>(random() % 12);
    std::vector<std::vector<VertexId>> faces(random() % 40);
    for (auto& face : faces) {
      face.resize(3 + random() % 3);
      for (VertexId& v : face) v = static_cast<VertexId>(random() % static_cast<unsigned>(n));
    }
    expect_split(Polygons(n, faces));
  }
}

TEST(SplitMesh, EveryConfigurationOfEightVoxelsBecomesAHalfedgeMesh) {
  for (unsigned mask = 1; mask < 256; ++mask) {
    BinaryVolume volume(Grid{{2, 2, 2}, {1, 1, 1}, {0, 0, 0}});
    for (unsigned i = 0; i < 8; ++i) {
      if ((mask >> i & 1) != 0) volume.set(i & 1, i >> 1 & 1, i >> 2);
    }
    const DigitalSurface surface = extract_surface(volume);
    Polygons p(0, {});
    p.positions = surface.positions().matrix();
    for (const QuadCorners& quad : surface.corners()) {
      p.corners.insert(p.corners.end(), quad.begin(), quad.end());
      p.offsets.push_back(std::ssize(p.corners));
    }
    expect_split(p);
  }
}

}  // namespace
}  // namespace dsc
