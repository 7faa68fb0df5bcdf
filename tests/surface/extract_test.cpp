#include "libdsc/surface/extract.h"

#include "libdsc/surface/topology.h"
#include "tests/support/long_tests.h"
#include "tests/support/random_volume.h"
#include "tests/support/surface_check.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <map>

namespace dsc {
namespace {

using testing::Cell;
using testing::expect_sound;
using testing::linel_of;

/// The two surfels of every mesh edge on a linel with four share the voxel that the adjacency says,
/// unless the edge was linked the other way to keep parallel edges apart: then both its ends are
/// vertices that the mesh has more often than there are umbrellas.
void expect_adjacency(const DigitalSurface& surface, const testing::VoxelTopology& truth) {
  const auto& mesh = surface.mesh();
  const bool inner = surface.adjacency() == Adjacency::interior;
  std::map<int, int> vertices_of_umbrella;
  OpenMesh::VPropHandleT<VertexId> ids;
  ASSERT_TRUE(mesh.get_property_handle(ids, property::kVertexId));
  for (const auto v : mesh.vertices()) ++vertices_of_umbrella[mesh.property(ids, v)];
  for (const auto e : mesh.edges()) {
    const auto h = mesh.halfedge_handle(e, 0), g = mesh.halfedge_handle(e, 1);
    if (truth.linels.at(linel_of(surface, h)).size() != 4) continue;
    const auto voxel = [&](OpenMesh::HalfedgeHandle half) {
      const Surfel s = surface.surfels()[static_cast<std::size_t>(mesh.face_handle(half).idx())];
      const auto& step = topology::kStep[s.direction];
      return inner ? Cell{s.x, s.y, s.z} : Cell{s.x + step[0], s.y + step[1], s.z + step[2]};
    };
    if (voxel(h) == voxel(g)) continue;
    EXPECT_GT(vertices_of_umbrella[mesh.property(ids, mesh.from_vertex_handle(h))], 1);
    EXPECT_GT(vertices_of_umbrella[mesh.property(ids, mesh.to_vertex_handle(h))], 1);
  }
}

void check_volume(const BinaryVolume& volume, const std::string& what) {
  for (const Adjacency adjacency : {Adjacency::interior, Adjacency::exterior}) {
    ExtractOptions options;
    options.adjacency = adjacency;
    const auto truth = testing::voxel_topology(volume, adjacency);
    expect_sound(extract_surface(volume, options), truth, what);
    options.glue = Glue::umbrella;
    const DigitalSurface by_umbrella = extract_surface(volume, options);
    expect_sound(by_umbrella, truth, what + " by umbrella");
    expect_adjacency(by_umbrella, truth);
  }
}

BinaryVolume configuration(int bits) {
  BinaryVolume volume(Grid{{2, 2, 2}, {1, 1, 1}, Vec3::Zero()});
  for (int v = 0; v < 8; ++v) volume.set(v & 1, v >> 1 & 1, v >> 2, (bits >> v & 1) != 0);
  return volume;
}

TEST(Extract, All256ConfigurationsAreSoundUnderBothAdjacencies) {
  for (int bits = 0; bits < 256; ++bits) {
    check_volume(configuration(bits), "configuration " + std::to_string(bits));
    if (HasFatalFailure()) return;
  }
}

/// 10 000 random volumes, 100 000 in long runs, in shards that CTest can run side by side.
class ExtractRandom : public ::testing::TestWithParam<unsigned> {
 protected:
  static constexpr unsigned kShards = 4;
};
INSTANTIATE_TEST_SUITE_P(Shards, ExtractRandom, ::testing::Range(0U, 4U));

TEST_P(ExtractRandom, VolumesAreSoundUnderBothAdjacencies) {
  for (unsigned seed = GetParam(); seed < testing::usually_or_long(10000U, 100000U);
       seed += kShards) {
    const double density = 0.1 + 0.8 * (seed % 17) / 16.0;
    const auto volume = testing::random_volume({4, 4, 4}, density, seed);
    for (const Adjacency adjacency : {Adjacency::interior, Adjacency::exterior}) {
      ExtractOptions options;
      options.adjacency = adjacency;
      options.glue = seed / kShards % 2 == 0 ? Glue::pointel : Glue::umbrella;
      expect_sound(extract_surface(volume, options, Context{1}),
                   testing::voxel_topology(volume, adjacency), "seed " + std::to_string(seed));
    }
    if (HasFatalFailure() || HasNonfatalFailure()) return;
  }
}

TEST(Extract, RowsLongerThanAWordAreSound) {
  for (const Index nx : {61, 62, 63, 64, 65, 127, 130}) {
    check_volume(testing::random_volume({nx, 3, 2}, 0.5, static_cast<unsigned>(nx)),
                 "row of " + std::to_string(nx));
    check_volume(testing::box_volume({nx, 1, 1}, {0, 0, 0}, {nx, 1, 1}), "bar");
    if (HasFatalFailure()) return;
  }
}

TEST(Extract, ABoxHasItsOwnCounts) {
  // a x b x c voxels: 2(ab + bc + ca) surfels on a sphere, so V = F + 2 and E = 2F.
  const DigitalSurface s = extract_surface(testing::box_volume({9, 9, 9}, {1, 2, 3}, {4, 6, 8}));
  const Index faces = 2 * (3 * 4 + 4 * 5 + 5 * 3);
  EXPECT_EQ(s.counts().faces, faces);
  EXPECT_EQ(s.counts().vertices, faces + 2);
  EXPECT_EQ(s.counts().edges, 2 * faces);
  EXPECT_EQ(s.counts().euler, 2);
  EXPECT_EQ(s.counts().components, 1);
}

TEST(Extract, PointelsLieHalfASpacingFromVoxelCentres) {
  BinaryVolume volume(Grid{{3, 3, 3}, {0.5, 2, 4}, {10, 20, 30}});
  volume.set(1, 1, 1);
  const DigitalSurface s = extract_surface(volume);
  ASSERT_EQ(s.vertex_count(), 8);
  for (VertexId v = 0; v < 8; ++v) {
    const Vec3 offset = (s.position(v) - Vec3(10.5, 22, 34)).cwiseAbs();
    EXPECT_EQ(offset, Vec3(0.25, 1, 2));
  }
}

TEST(Extract, CornersRunCounterClockwiseSeenFromOutside) {
  const DigitalSurface s = extract_surface(testing::random_volume({6, 6, 6}, 0.4, 7));
  for (std::size_t f = 0; f < s.surfels().size(); ++f) {
    const QuadCorners& c = s.corners()[f];
    const Vec3 x0 = s.position(c[0]), x1 = s.position(c[1]), x2 = s.position(c[2]),
               x3 = s.position(c[3]);
    EXPECT_EQ((x1 - x0).cross(x3 - x0), s.surfels()[f].normal());
    EXPECT_EQ(x2 - x3, x1 - x0);
    EXPECT_EQ((x0 + x2) / 2, s.surfels()[f].centre(s.grid()));
  }
}

TEST(Extract, BoxesThatFillWholeWordsKeepTheirSurfels) {
  // Bits start at x = -1, so a word begins at x = 63; rows are looked at 64 at a time.
  for (const Index x0 : {0, 62, 63, 64}) {
    for (const Index x1 : {126, 127, 128}) {
      for (const Index y0 : {0, 63, 64, 65}) {
        for (const Index y1 : {127, 128, 129, 200}) {
          const DigitalSurface s =
              extract_surface(testing::box_volume({130, 200, 3}, {x0, y0, 0}, {x1, y1, 3}));
          const Index a = x1 - x0, b = y1 - y0;
          ASSERT_EQ(s.counts().faces, 2 * (a * b + 3 * b + 3 * a))
              << x0 << " " << x1 << " " << y0 << " " << y1;
          ASSERT_EQ(s.counts().euler, 2);
          ASSERT_EQ(s.counts().boundary_edges, 0);
        }
      }
    }
  }
}

TEST(Extract, AnEmptyVolumeHasAnEmptySurface) {
  for (const Index3 size : {Index3{0, 0, 0}, Index3{5, 4, 3}, Index3{70, 0, 3}}) {
    const DigitalSurface s = extract_surface(BinaryVolume(Grid{size, {1, 1, 1}, Vec3::Zero()}));
    EXPECT_EQ(s.face_count(), 0);
    EXPECT_EQ(s.vertex_count(), 0);
    EXPECT_EQ(s.mesh().n_edges(), 0u);
  }
}

TEST(Extract, AFullVolumeIsClosedOrOpenAtItsBorderOnRequest) {
  const auto full = testing::box_volume({4, 3, 2}, {0, 0, 0}, {4, 3, 2});
  EXPECT_EQ(extract_surface(full).counts().faces, 2 * (12 + 6 + 8));
  EXPECT_EQ(extract_surface(full).counts().boundary_edges, 0);
  ExtractOptions open;
  open.border = Border::open;
  EXPECT_EQ(extract_surface(full, open).counts().faces, 0);
  // A slab that touches four sides: two sheets with a boundary each.
  const auto slab = testing::box_volume({4, 3, 5}, {0, 0, 1}, {4, 3, 3});
  const DigitalSurface s = extract_surface(slab, open);
  EXPECT_EQ(s.counts().faces, 24);
  EXPECT_EQ(s.counts().components, 2);
  EXPECT_EQ(s.counts().boundary_edges, 2 * 14);
  EXPECT_EQ(s.counts().euler, 2);
  EXPECT_EQ(testing::mesh_fault(s), "");
}

TEST_P(ExtractRandom, PartsAreSound) {
  for (unsigned seed = GetParam(); seed < testing::usually_or_long(3000U, 30000U);
       seed += kShards) {
    const auto volume = testing::random_volume({4, 4, 4}, 0.3 + 0.1 * (seed % 5), seed);
    const auto kept = [seed](const Cell& c) {
      const unsigned hash = static_cast<unsigned>(c[0] * 73 + c[1] * 179 + c[2] * 283) + seed;
      return hash * 2654435761u >> 30 != 0;  // three of four
    };
    for (const Adjacency adjacency : {Adjacency::interior, Adjacency::exterior}) {
      ExtractOptions options;
      options.adjacency = adjacency;
      options.glue = seed / kShards % 2 == 0 ? Glue::pointel : Glue::umbrella;
      options.part = [&](const Surfel& s) { return kept(testing::cell_of(s)); };
      expect_sound(extract_surface(volume, options, Context{1}),
                   testing::voxel_topology(volume, adjacency, kept),
                   "part " + std::to_string(seed));
    }
    if (HasFatalFailure() || HasNonfatalFailure()) return;
  }
}

TEST(Extract, TheSurfaceDoesNotDependOnThreads) {
  const auto volume = testing::random_volume({70, 20, 20}, 0.3, 5);
  const DigitalSurface one = extract_surface(volume, {}, Context{1});
  for (const int threads : {2, 4, 8}) {
    const DigitalSurface many = extract_surface(volume, {}, Context{threads});
    ASSERT_EQ(one.mesh().n_vertices(), many.mesh().n_vertices());
    ASSERT_TRUE(std::equal(one.corners().begin(), one.corners().end(), many.corners().begin()));
    for (const auto h : one.mesh().halfedges()) {
      ASSERT_EQ(one.mesh().to_vertex_handle(h), many.mesh().to_vertex_handle(h));
      ASSERT_EQ(one.mesh().next_halfedge_handle(h), many.mesh().next_halfedge_handle(h));
    }
  }
}

TEST(Extract, CanBeCancelled) {
  Monitor monitor;
  monitor.cancel();
  EXPECT_THROW(extract_surface(testing::box_volume({8, 8, 8}, {1, 1, 1}, {5, 5, 5}), {},
                               Context{1, &monitor}),
               Cancelled);
}

TEST(DigitalSurface, CopiesKeepTheirOwnNormals) {
  DigitalSurface a = extract_surface(testing::box_volume({3, 3, 3}, {1, 1, 1}, {2, 2, 2}));
  Eigen::Matrix3Xd u(3, 6);
  for (int f = 0; f < 6; ++f) u.col(f) = a.surfels()[static_cast<std::size_t>(f)].normal();
  EXPECT_TRUE(a.normals().empty());
  a.set_normals(u);
  const DigitalSurface b = a;
  a.remove_normals();
  EXPECT_TRUE(a.normals().empty());
  EXPECT_EQ(b.normals().matrix(), u);
  EXPECT_EQ(b.corners().size(), 6u);
  EXPECT_FALSE(b.flat(false).has_normals());
  EXPECT_TRUE(b.flat().has_normals());
  EXPECT_THROW(a.set_normals(Eigen::Matrix3Xd::Zero(3, 5)), UsageError);
}

}  // namespace
}  // namespace dsc
