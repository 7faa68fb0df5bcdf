// Distances from sources at every kind of place of a digital surface, against shortest paths along
// the sides and diagonals of its faces.
#include "libdsc/algorithms/geodesic.h"
#include "libdsc/algorithms/heat_front.h"
#include "libdsc/base/error.h"
#include "libdsc/normals/surface_normals.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "tests/algorithms/meshes.h"
#include "tests/solve/grid_systems.h"
#include "tests/support/random_volume.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <set>
#include <string>
#include <vector>

namespace dsc {
namespace {

using testing::kInfinity;

/// Lengths of the shortest paths over faces; longer than the true distance by 8 % at most where the
/// surface is flat. Infinite where no path leads.
Eigen::VectorXd paths(const FlatMesh& mesh, const std::vector<VertexId>& sources) {
  std::vector<std::vector<std::pair<VertexId, double>>> next(
      static_cast<std::size_t>(mesh.vertices()));
  for (Index f = 0; f < mesh.faces(); ++f) {
    for (const VertexId v : mesh.face(f)) {
      for (const VertexId w : mesh.face(f)) {
        next[static_cast<std::size_t>(v)].emplace_back(
            w, (mesh.positions[v] - mesh.positions[w]).norm());
      }
    }
  }
  Eigen::VectorXd distance = Eigen::VectorXd::Constant(mesh.vertices(), kInfinity);
  std::priority_queue<std::pair<double, VertexId>> open;
  for (const VertexId s : sources) open.emplace(distance[s] = 0, s);
  while (!open.empty()) {
    const auto [minus, v] = open.top();
    open.pop();
    if (-minus > distance[v]) continue;
    for (const auto& [w, length] : next[static_cast<std::size_t>(v)]) {
      if (distance[v] + length >= distance[w]) continue;
      distance[w] = distance[v] + length;
      open.emplace(-distance[w], w);
    }
  }
  return distance;
}

/// Vertices of sides with one face, counted from the corners.
std::vector<VertexId> boundary_of(const FlatMesh& mesh) {
  std::map<std::pair<VertexId, VertexId>, int> sides;
  for (Index f = 0; f < mesh.faces(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t i = 0; i < face.size(); ++i) {
      const auto side = std::minmax(face[i], face[(i + 1) % face.size()]);
      ++sides[{side.first, side.second}];
    }
  }
  std::set<VertexId> ends;
  for (const auto& [side, count] : sides) {
    if (count == 1) ends.insert({side.first, side.second});
  }
  return {ends.begin(), ends.end()};
}

/// Vertices that the halfedge mesh has more than once: several umbrellas.
std::vector<VertexId> pinched_of(const DigitalSurface& surface) {
  OpenMesh::VPropHandleT<VertexId> ids;
  EXPECT_TRUE(surface.mesh().get_property_handle(ids, property::kVertexId));
  std::map<VertexId, int> count;
  for (const auto v : surface.mesh().vertices()) ++count[surface.mesh().property(ids, v)];
  std::vector<VertexId> pinched;
  for (const auto& [id, times] : count) {
    if (times > 1) pinched.push_back(id);
  }
  return pinched;
}

/// One vertex of each component.
std::vector<VertexId> one_each(const FlatMesh& mesh) {
  std::vector<VertexId> chosen;
  Eigen::VectorXd reached = Eigen::VectorXd::Constant(mesh.vertices(), kInfinity);
  for (VertexId v = 0; v < mesh.vertices(); ++v) {
    if (reached[v] < kInfinity) continue;
    chosen.push_back(v);
    reached = reached.cwiseMin(paths(mesh, {v}));
  }
  return chosen;
}

void expect_distances(const FlatMesh& mesh, const std::vector<VertexId>& sources,
                      const std::string& what) {
  const Eigen::VectorXd truth = paths(mesh, sources);
  for (const HeatMethod method : {HeatMethod::direct, HeatMethod::bands, HeatMethod::automatic}) {
    for (const HeatBoundary boundary : {HeatBoundary::neumann, HeatBoundary::mixed}) {
      GeodesicOptions options;
      options.method = method;
      options.boundary = boundary;
      const GeodesicResult result = geodesic_distance(mesh, sources, options);
      for (Index v = 0; v < mesh.vertices(); ++v) {
        const double d = result.distance[v];
        if (truth[v] == kInfinity) {
          ASSERT_EQ(d, kInfinity) << what << ", vertex " << v << ", where nothing reaches";
        } else {
          ASSERT_TRUE(d >= 0 && std::isfinite(d)) << what << ", vertex " << v << ": " << d;
          ASSERT_GE(d, 0.7 * truth[v] - 2) << what << ", vertex " << v;
          ASSERT_LE(d, 1.2 * truth[v] + 2) << what << ", vertex " << v;
        }
      }
      for (const VertexId s : sources) ASSERT_EQ(result.distance[s], 0) << what;
    }
  }
}

BinaryVolume islands() {
  auto volume = testing::box_volume({30, 22, 12}, {2, 2, 2}, {12, 10, 9});
  const auto add = [&](Index3 lo, Index3 hi) {
    for (Index z = lo[2]; z < hi[2]; ++z) {
      for (Index y = lo[1]; y < hi[1]; ++y) {
        for (Index x = lo[0]; x < hi[0]; ++x) volume.set(x, y, z);
      }
    }
  };
  add({15, 3, 3}, {16, 4, 4});    // one voxel
  add({18, 2, 2}, {27, 4, 4});    // a bar
  add({3, 13, 3}, {9, 19, 8});    // a box
  add({9, 19, 8}, {13, 21, 11});  // that touches it in a corner
  add({16, 12, 3}, {20, 16, 8});  // and two
  add({20, 16, 3}, {24, 20, 8});  // that touch along an edge
  return volume;
}

struct Surface {
  std::string name;
  DigitalSurface surface;
};

std::vector<Surface> surfaces() {
  std::vector<Surface> all;
  ExtractOptions open;
  open.border = Border::open;
  all.push_back({"islands", extract_surface(islands())});
  all.push_back({"islands, exterior adjacency", [] {
                   ExtractOptions options;
                   options.adjacency = Adjacency::exterior;
                   return extract_surface(islands(), options);
                 }()});
  ExtractOptions part;  // with holes and stray faces
  part.part = [](const Surfel& s) { return (s.x * 7 + s.y * 5 + s.z * 3) % 11 != 0; };
  all.push_back({"islands with holes", extract_surface(islands(), part)});
  all.push_back({"a slab cut by the border",
                 extract_surface(testing::box_volume({14, 12, 9}, {0, 0, 3}, {14, 12, 6}), open)});
  all.push_back({"random voxels", extract_surface(testing::random_volume({7, 7, 7}, 0.25, 3))});
  all.push_back(
      {"random voxels, open", extract_surface(testing::random_volume({7, 7, 7}, 0.5, 4), open)});
  return all;
}

TEST(SourcePlaces, OneOnEachComponentOrOnSomeOnly) {
  int tested = 0;
  for (const Surface& s : surfaces()) {
    const FlatMesh mesh = s.surface.flat();
    const std::vector<VertexId> each = one_each(mesh);
    if (each.size() == 1) continue;
    ++tested;
    expect_distances(mesh, each, s.name + ", each component");
    expect_distances(mesh, {each.front()}, s.name + ", the first component");
    expect_distances(mesh, {each.back()}, s.name + ", the last component");
    std::vector<VertexId> all_but_one(each.begin() + 1, each.end());
    expect_distances(mesh, all_but_one, s.name + ", all but the first");
    if (HasFailure()) return;
  }
  EXPECT_GE(tested, 4);
}

TEST(SourcePlaces, OnTheBoundary) {
  int tested = 0;
  for (const Surface& s : surfaces()) {
    const FlatMesh mesh = s.surface.flat();
    const std::vector<VertexId> boundary = boundary_of(mesh);
    if (boundary.empty()) continue;
    ++tested;
    expect_distances(mesh, boundary, s.name + ", all of the boundary");
    for (std::size_t i = 0; i < boundary.size(); i += 1 + boundary.size() / 6) {
      expect_distances(mesh, {boundary[i]}, s.name + ", one of the boundary");
    }
    if (HasFailure()) return;
  }
  EXPECT_GE(tested, 3);
}

TEST(SourcePlaces, OnPinchedVertices) {
  int tested = 0;
  for (const Surface& s : surfaces()) {
    const FlatMesh mesh = s.surface.flat();
    const std::vector<VertexId> pinched = pinched_of(s.surface);
    if (pinched.empty()) continue;
    ++tested;
    expect_distances(mesh, pinched, s.name + ", all pinched");
    for (std::size_t i = 0; i < pinched.size(); i += 1 + pinched.size() / 6) {
      expect_distances(mesh, {pinched[i]}, s.name + ", pinched " + std::to_string(pinched[i]));
    }
    if (HasFailure()) return;
  }
  EXPECT_GE(tested, 4);
}

TEST(SourcePlaces, AllVerticesOrNone) {
  for (const Surface& s : surfaces()) {
    const FlatMesh mesh = s.surface.flat();
    std::vector<VertexId> all;
    for (VertexId v = 0; v < mesh.vertices(); ++v) all.push_back(v);
    expect_distances(mesh, all, s.name + ", all vertices");
    all.erase(all.begin() + all.size() / 2);
    expect_distances(mesh, all, s.name + ", all vertices but one");
    EXPECT_THROW((void)geodesic_distance(mesh, {}), UsageError) << s.name;
    if (HasFailure()) return;
  }
}

/// The same under the projected calculus, whose distances are those of a smoothed surface: finite
/// exactly where a path leads, zero at the sources, never negative.
TEST(SourcePlaces, UnderEstimatedNormalsToo) {
  for (Surface& s : surfaces()) {
    (void)trivial_normals(s.surface);
    const FlatMesh mesh = s.surface.flat();
    for (const std::vector<VertexId>& sources :
         {one_each(mesh), boundary_of(mesh), pinched_of(s.surface)}) {
      if (sources.empty()) continue;
      const Eigen::VectorXd truth = paths(mesh, sources);
      for (const HeatMethod method : {HeatMethod::direct, HeatMethod::bands}) {
        GeodesicOptions options;
        options.method = method;
        const Eigen::VectorXd d = geodesic_distance(mesh, sources, options).distance;
        for (Index v = 0; v < d.size(); ++v) {
          ASSERT_EQ(d[v] == kInfinity, truth[v] == kInfinity) << s.name << ", vertex " << v;
          ASSERT_GE(d[v], 0) << s.name << ", vertex " << v;
        }
        for (const VertexId v : sources) ASSERT_EQ(d[v], 0);
      }
    }
  }
}

/// Bands on matrices without an answer.
TEST(SourcePlaces, BandsOfBadMatricesAreErrorsOrSaySo) {
  const Index n = 30;
  const SparseMatrix L = testing::grid_laplacian(n, n), I = testing::identity(n * n);
  SparseMatrix nan = L + I;
  nan.coeffRef(40, 40) = std::nan("");
  const std::vector<VertexId> source{3};
  for (const SparseMatrix& A :
       {SparseMatrix(-1. * (L + I)), SparseMatrix(L - 5. * I), nan, SparseMatrix(0. * L)}) {
    EXPECT_THROW((void)diffuse_front(A, source), SolverError);
  }
  // What a band cannot see, the residual of the whole tells: NaN and bad couplings among others.
  const HeatFront front = diffuse_front(L + I, source);
  EXPECT_LT(componentwise_residual(L + I, front.w, source), 1e-4);
  EXPECT_FALSE(componentwise_residual(L + 1.5 * I, front.w, source) <= 1e-2);
  EXPECT_FALSE(componentwise_residual(nan, front.w, source) <= 1e-2);
}

}  // namespace
}  // namespace dsc
