/// \file
/// Whether an extracted surface is what the voxels say.
#pragma once

#include "tests/support/mesh_check.h"
#include "tests/support/voxel_topology.h"

#include <gtest/gtest.h>
#include <OpenMesh/Tools/Utils/MeshCheckerT.hh>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace dsc::testing {

inline void expect_counts(const SurfaceCounts& a, const SurfaceCounts& b, const std::string& what) {
  EXPECT_EQ(a.vertices, b.vertices) << what;
  EXPECT_EQ(a.edges, b.edges) << what;
  EXPECT_EQ(a.faces, b.faces) << what;
  EXPECT_EQ(a.euler, b.euler) << what;
  EXPECT_EQ(a.components, b.components) << what;
  EXPECT_EQ(a.boundary_edges, b.boundary_edges) << what;
  EXPECT_EQ(a.nonmanifold_edges, b.nonmanifold_edges) << what;
  EXPECT_EQ(a.pinched_vertices, b.pinched_vertices) << what;
}

/// The linel under each mesh edge, found from the positions of its ends.
inline Cell linel_of(const DigitalSurface& surface, OpenMesh::HalfedgeHandle h) {
  const auto& mesh = surface.mesh();
  const auto middle =
      (mesh.point(mesh.from_vertex_handle(h)) + mesh.point(mesh.to_vertex_handle(h))) * 0.5;
  Cell c{};
  for (int a = 0; a < 3; ++a) {  // unit spacing, origin 0: pointel i is at i - 1/2
    c[static_cast<std::size_t>(a)] = static_cast<int>(std::lround(2 * (middle[a] + 0.5)));
  }
  return c;
}

inline void expect_sound(const DigitalSurface& surface, const VoxelTopology& truth,
                         const std::string& what) {
  ASSERT_EQ(mesh_fault(surface), "") << what;
  OpenMesh::Utils::MeshCheckerT<SurfaceMesh> checker(surface.mesh());
  std::ostringstream messages;
  ASSERT_TRUE(checker.check(OpenMesh::Utils::MeshCheckerT<SurfaceMesh>::CHECK_ALL, messages))
      << what << messages.str();
  expect_counts(surface.counts(), truth.counts, what);

  std::vector<Cell> surfels;
  for (const Surfel& s : surface.surfels()) surfels.push_back(cell_of(s));
  std::sort(surfels.begin(), surfels.end());
  ASSERT_EQ(surfels, truth.surfels) << what << ": each exactly once";

  // Every side of every surfel lies on its own linel, and each linel has its surfels.
  std::vector<std::size_t> sides(truth.linels.size(), 0);
  for (const auto h : surface.mesh().halfedges()) {
    if (surface.mesh().is_boundary(h)) continue;
    const Cell linel = linel_of(surface, h);
    ++sides[truth.linels.index(linel)];
    const Cell s =
        cell_of(surface.surfels()[static_cast<std::size_t>(surface.mesh().face_handle(h).idx())]);
    ASSERT_TRUE(truth.linels.at(linel).has(s)) << what;
  }
  truth.linels.for_each([&](const Cell& linel, const Around& around) {
    EXPECT_EQ(sides[truth.linels.index(linel)], around.size()) << what;
  });
}

}  // namespace dsc::testing
