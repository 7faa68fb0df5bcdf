#include "libdsc/surface/surface_builder.h"

#include "libdsc/base/checked.h"
#include "libdsc/base/parallel.h"
#include "libdsc/base/union_find.h"
#include "libdsc/surface/halfedges.h"
#include "libdsc/surface/umbrellas.h"

#include <algorithm>

namespace dsc {
namespace {

using topology::Junction;
using topology::kNoSide;
using topology::SideCode;

constexpr Index kGrain = 8192;

/// Two edges at one linel that would join the same two mesh vertices are linked the other way
/// round, which splits both their umbrellas: crossing to the other partner is a transposition
/// within one orbit. Returns the corners whose umbrellas were split.
std::vector<SideCode> separate_parallel_edges(std::vector<SideCode>& opposite,
                                              const std::vector<Junction>& junctions) {
  std::vector<SideCode> split;
  const auto same_umbrella = [&](SideCode a, SideCode b) {
    return topology::leader_of(a, opposite) == topology::leader_of(b, opposite);
  };
  const auto relink = [&](SideCode side, SideCode partner) {
    opposite[static_cast<std::size_t>(side)] = partner;
    if (partner != kNoSide) opposite[static_cast<std::size_t>(partner)] = side;
  };
  for (const Junction& j : junctions) {
    for (int k = 0; k < 2; ++k) {
      // Two sides that run the same way along the linel, so they are of two edges.
      const SideCode x = j.sides[static_cast<std::size_t>(k)];
      const SideCode y = j.sides[static_cast<std::size_t>(k) + 2];
      if (x == kNoSide || y == kNoSide) continue;
      if (!same_umbrella(x, y) || !same_umbrella(topology::next_side(x), topology::next_side(y))) {
        continue;
      }
      const SideCode x_partner = opposite[static_cast<std::size_t>(x)];
      const SideCode y_partner = opposite[static_cast<std::size_t>(y)];
      relink(x, y_partner);
      relink(y, x_partner);
      for (const SideCode s : {x, y}) {
        split.push_back(s);
        split.push_back(topology::next_side(s));
      }
    }
  }
  return split;
}

SurfaceCounts glued_counts(std::span<const QuadCorners> corners, Index vertices,
                           const std::vector<SideCode>& opposite,
                           const std::vector<Junction>& junctions, const Context& context) {
  struct Sides {
    Index edges = 0, unlinked = 0;
  };
  const auto count = [&](SideCode s, Sides& sides) {
    const SideCode o = opposite[static_cast<std::size_t>(s)];
    if (o == kNoSide) ++sides.unlinked;
    if (o < s) ++sides.edges;  // each edge once: by its later side, or by its only one
  };
  UnionFind components(vertices);
  Sides sides = parallel_reduce(
      context, static_cast<Index>(corners.size()), kGrain, Sides{},
      [&](Index first, Index last) {
        Sides partial;
        for (Index f = first; f < last; ++f) {
          const QuadCorners& c = corners[static_cast<std::size_t>(f)];
          for (int i = 0; i < 4; ++i) count(topology::side_code(f, i), partial);
          for (std::size_t i = 1; i < 4; ++i) components.join(c[0], c[i]);
        }
        return partial;
      },
      [](Sides a, const Sides& b) {
        return Sides{a.edges + b.edges, a.unlinked + b.unlinked};
      });
  SurfaceCounts counts;
  for (const Junction& j : junctions) {
    Sides here;
    Index present = 0;
    for (const SideCode s : j.sides) {
      if (s == kNoSide) continue;
      ++present;
      count(s, here);
    }
    sides.edges -= here.edges - 1;  // one linel, however many edges of the mesh
    sides.unlinked -= here.unlinked;
    if (present > 2) ++counts.nonmanifold_edges;
  }
  counts.vertices = vertices;
  counts.faces = static_cast<Index>(corners.size());
  counts.edges = sides.edges;
  counts.boundary_edges = sides.unlinked;
  counts.euler = counts.vertices - counts.edges + counts.faces;
  for (Index v = 0; v < vertices; ++v) {
    const auto id = static_cast<VertexId>(v);
    if (components.find(id) == id) ++counts.components;
  }
  return counts;
}

}  // namespace

SurfaceBuilder::SurfaceBuilder(const Grid& grid, Index vertices, Index faces) {
  (void)checked_id(checked_product(8, faces, "surface halfedges"), "surface halfedges");
  (void)checked_id(vertices, "surface vertices");
  surface_.grid_ = grid;
  surface_.vertex_count_ = vertices;
  surface_.mesh().resize(static_cast<std::size_t>(vertices), 0, static_cast<std::size_t>(faces));
  opposite_.resize(static_cast<std::size_t>(4 * faces));
}

std::span<Surfel> SurfaceBuilder::surfels() {
  SurfaceMesh& mesh = surface_.mesh();
  if (mesh.n_faces() == 0) return {};
  return {&mesh.property(surface_.surfels_, OpenMesh::FaceHandle(0)), mesh.n_faces()};
}

std::span<QuadCorners> SurfaceBuilder::corners() {
  SurfaceMesh& mesh = surface_.mesh();
  if (mesh.n_faces() == 0) return {};
  return {&mesh.property(surface_.corners_, OpenMesh::FaceHandle(0)), mesh.n_faces()};
}

std::span<OpenMesh::Vec3d> SurfaceBuilder::positions() {
  SurfaceMesh& mesh = surface_.mesh();
  if (mesh.n_vertices() == 0) return {};
  return {&mesh.point(OpenMesh::VertexHandle(0)), mesh.n_vertices()};
}

DigitalSurface SurfaceBuilder::finish(Adjacency adjacency, Glue glue, const Context& context) && {
  const Index pointels = surface_.vertex_count_;
  const auto table = corners();
  context.begin("link", 4);
  const auto umbrellas = topology::find_umbrellas(table, opposite_, pointels, context);
  context.advance(1);

  surface_.adjacency_ = adjacency;
  surface_.glue_ = glue;
  surface_.counts_ = glued_counts(table, pointels, opposite_, junctions_, context);
  const auto pointel_of = [&](SideCode corner) {
    return table[static_cast<std::size_t>(topology::face_of(corner))]
                [static_cast<std::size_t>(corner & 3)];
  };
  VertexId last = -1;
  for (const SideCode leader : umbrellas.further) {
    if (pointel_of(leader) != last) ++surface_.counts_.pinched_vertices;
    last = pointel_of(leader);
  }
  context.advance(1);

  // Mesh vertices: a pointel's first umbrella has the pointel's own number, then come the further
  // umbrellas, then the copies.
  std::vector<SideCode> leaders = umbrellas.first;
  leaders.insert(leaders.end(), umbrellas.further.begin(), umbrellas.further.end());
  const auto umbrella_count = static_cast<Index>(leaders.size());
  std::vector<VertexId> origin(umbrellas.further.size());  // pointels of the vertices beyond
  std::transform(umbrellas.further.begin(), umbrellas.further.end(), origin.begin(), pointel_of);

  // Corners of the mesh, kept apart from the side table only where the two differ.
  std::vector<QuadCorners> own;
  std::span<QuadCorners> mesh_corners = table;
  const bool split_table = umbrella_count > pointels;
  std::vector<SideCode> linked;
  const bool has_junctions = !junctions_.empty();
  if (split_table || has_junctions) {
    own.assign(table.begin(), table.end());
    mesh_corners = own;
  }
  const auto name = [&](std::span<QuadCorners> corners, SideCode leader, Index id) {
    topology::for_each_around(leader, opposite_, [&](SideCode c) {
      corners[static_cast<std::size_t>(topology::face_of(c))][static_cast<std::size_t>(c & 3)] =
          static_cast<VertexId>(id);
    });
  };
  for (Index v = pointels; v < umbrella_count; ++v) {
    name(mesh_corners, leaders[static_cast<std::size_t>(v)], v);
  }
  const auto corner_of = [&](SideCode c) {
    return own[static_cast<std::size_t>(topology::face_of(c))][static_cast<std::size_t>(c & 3)];
  };
  std::vector<QuadCorners> by_umbrella;
  if (glue == Glue::umbrella) by_umbrella = own;

  // Every orbit that a split has made touches a split linel; the one with the umbrella's old leader
  // keeps the umbrella's number.
  const auto split = separate_parallel_edges(opposite_, junctions_);
  std::vector<std::pair<VertexId, SideCode>> copies;
  for (const SideCode corner : split) {
    const VertexId v = corner_of(corner);
    const SideCode leader = topology::leader_of(corner, opposite_);
    if (leader != topology::leader_of(leaders[static_cast<std::size_t>(v)], opposite_)) {
      copies.emplace_back(v, leader);
    }
  }
  std::sort(copies.begin(), copies.end());
  copies.erase(std::unique(copies.begin(), copies.end()), copies.end());
  for (const auto& [v, leader] : copies) {
    origin.push_back(pointel_of(leader));
    leaders.push_back(leader);
    name(mesh_corners, leader, static_cast<Index>(leaders.size()) - 1);
  }
  context.advance(1);

  SurfaceMesh& mesh = surface_.mesh();
  const std::vector<VertexId> pointel_of_extra = std::move(origin);
  topology::write_halfedges(mesh, mesh_corners, opposite_, leaders, context);
  const auto points = positions();
  for (std::size_t k = 0; k < pointel_of_extra.size(); ++k) {
    points[static_cast<std::size_t>(pointels) + k] =
        points[static_cast<std::size_t>(pointel_of_extra[k])];
  }

  // Vertex ids: of pointels, or of umbrellas; a copy belongs to its umbrella either way.
  OpenMesh::VPropHandleT<VertexId> ids;
  mesh.add_property(ids, property::kVertexId);
  const auto id = [&](Index v) -> VertexId& {
    return mesh.property(ids, OpenMesh::VertexHandle(static_cast<int>(v)));
  };
  const Index vertex_ids = glue == Glue::umbrella ? umbrella_count : pointels;
  for (Index v = 0; v < static_cast<Index>(leaders.size()); ++v) {
    if (v < vertex_ids) {
      id(v) = static_cast<VertexId>(v);
    } else if (glue == Glue::pointel) {
      id(v) = pointel_of_extra[static_cast<std::size_t>(v - pointels)];
    } else {
      id(v) = copies[static_cast<std::size_t>(v - umbrella_count)].first;
    }
  }
  if (glue == Glue::umbrella && !by_umbrella.empty()) {
    std::copy(by_umbrella.begin(), by_umbrella.end(), corners().begin());
  }
  surface_.vertex_count_ = vertex_ids;
  context.advance(1);
  return std::move(surface_);
}

}  // namespace dsc
