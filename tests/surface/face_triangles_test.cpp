#include "libdsc/surface/face_triangles.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace dsc {
namespace {

using Triangles = std::vector<std::array<std::size_t, 3>>;

/// Of the only face, with these corners in the plane.
Triangles triangles_of(const std::vector<std::array<double, 2>>& corners) {
  std::vector<double> positions;
  std::vector<VertexId> ids;
  for (const auto& [x, y] : corners) {
    ids.push_back(static_cast<VertexId>(ids.size()));
    positions.insert(positions.end(), {x, y, 0.});
  }
  const std::vector<Index> offsets = {0, static_cast<Index>(ids.size())};
  FlatMesh mesh;
  mesh.positions = {positions.data(), static_cast<Index>(ids.size())};
  mesh.corners = ids;
  mesh.offsets = offsets;
  Triangles triangles;
  for_each_triangle(mesh, 0, [&](std::size_t a, std::size_t b, std::size_t c) {
    triangles.push_back({a, b, c});
  });
  return triangles;
}

TEST(FaceTriangles, AQuadIsCutAlongItsShorterDiagonal) {
  EXPECT_EQ(triangles_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(triangles_of({{0, 0}, {2, -1}, {1, 0}, {2, 1}}), (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(triangles_of({{-3, 0}, {0, -1}, {3, 0}, {0, 1}}), (Triangles{{1, 2, 3}, {1, 3, 0}}));
}

TEST(FaceTriangles, OtherFacesAreFansFromTheirFirstCorner) {
  EXPECT_EQ(triangles_of({{0, 0}, {1, 0}, {0, 1}}), (Triangles{{0, 1, 2}}));
  EXPECT_EQ(triangles_of({{0, 0}, {2, 0}, {3, 1}, {2, 2}, {0, 2}}),
            (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
  EXPECT_EQ(triangles_of({{0, 0}, {1, 0}}), Triangles{});
}

}  // namespace
}  // namespace dsc
