#include "libdsc/surface/surface_builder.h"

#include "libdsc/base/checked.h"
#include "libdsc/surface/halfedges.h"
#include "libdsc/surface/mesh_vertices.h"
#include "libdsc/surface/surface_counts.h"
#include "libdsc/surface/umbrellas.h"

namespace dsc {

namespace {

/// What is filled: positions and halfedges of vertices; halfedge, surfel, corners, labels and links
/// of faces, and junctions at half of their sides, collected and joined.
Index filled_bytes(Index vertices, Index faces, bool with_labels) {
  return (24 + 4) * vertices + (4 + 16 + 16 + (with_labels ? 8 : 0) + 4 * 4 + 3 * 16) * faces;
}

/// What finish() takes at most beside that: a face has two edges of two halfedges each, and per
/// side a halfedge in a list; a vertex its id, its leader and its pointel. Where vertices are split,
/// there are two more sets of corners, and as many vertices as umbrellas, of three corners each.
Index linked_bytes(Index vertices, Index faces) {
  constexpr Index kVertex = 4 + 4 + 4;
  constexpr Index kUmbrella = kVertex + 24 + 4;
  return kVertex * vertices + (2 * 2 * 16 + 4 * 4 + 2 * 16 + kUmbrella * 4 / 3) * faces;
}

}  // namespace

SurfaceBuilder::SurfaceBuilder(const Grid& grid, Index vertices, Index faces, bool with_labels,
                               const Context& context) {
  (void)checked_id(checked_product(8, faces, "surface halfedges"), "surface halfedges");
  (void)checked_id(vertices, "surface vertices");
  context.need("extract", filled_bytes(vertices, faces, with_labels));
  surface_.grid_ = grid;
  surface_.vertex_count_ = vertices;
  if (with_labels) surface_.mesh().add_property(surface_.labels_, property::kLabels);
  // A few more vertices are common, and would move all the others.
  surface_.mesh().reserve(static_cast<std::size_t>(vertices + vertices / 16), 0,
                          static_cast<std::size_t>(faces));
  surface_.mesh().resize(static_cast<std::size_t>(vertices), 0, static_cast<std::size_t>(faces));
  opposite_ =
      std::make_unique_for_overwrite<topology::SideCode[]>(static_cast<std::size_t>(4 * faces));
}

std::span<Surfel> SurfaceBuilder::surfels() {
  SurfaceMesh& mesh = surface_.mesh();
  if (mesh.n_faces() == 0) return {};
  return {&mesh.property(surface_.surfels_, OpenMesh::FaceHandle(0)), mesh.n_faces()};
}

std::span<LabelPair> SurfaceBuilder::labels() {
  SurfaceMesh& mesh = surface_.mesh();
  if (mesh.n_faces() == 0 || !surface_.labels_.is_valid()) return {};
  return {&mesh.property(surface_.labels_, OpenMesh::FaceHandle(0)), mesh.n_faces()};
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
  context.begin("link", 3);
  context.need("link", linked_bytes(pointels, static_cast<Index>(surfels().size())));
  SurfaceCounts& counts = surface_.counts_;
  counts = topology::count_glued(corners(), pointels, opposite(), junctions_, labels(), context);
  context.advance(1);
  const topology::MeshVertices vertices =
      topology::number_mesh_vertices(corners(), pointels, opposite(), junctions_, context);
  counts.pinched_vertices = vertices.pinched;
  context.advance(1);

  SurfaceMesh& mesh = surface_.mesh();
  topology::write_halfedges(mesh, corners(), opposite(), vertices.leaders, pointels, context);
  const auto points = positions();
  OpenMesh::VPropHandleT<VertexId> ids;
  mesh.add_property(ids, property::kVertexId);
  for (std::size_t v = 0; v < vertices.leaders.size(); ++v) {
    const auto index = static_cast<Index>(v);
    VertexId id = static_cast<VertexId>(v);
    if (index >= pointels) {
      const VertexId pointel = vertices.pointel_of[v - static_cast<std::size_t>(pointels)];
      points[v] = points[static_cast<std::size_t>(pointel)];
      id = glue == Glue::pointel ? pointel : vertices.umbrella_of(index);
    }
    mesh.property(ids, OpenMesh::VertexHandle(static_cast<int>(v))) = id;
  }
  if (glue == Glue::umbrella) {
    const auto table = corners();
    for (Index v = pointels; v < static_cast<Index>(vertices.leaders.size()); ++v) {
      topology::for_each_around(
          vertices.leaders[static_cast<std::size_t>(v)], opposite(), [&](topology::SideCode c) {
            table[static_cast<std::size_t>(topology::face_of(c))][static_cast<std::size_t>(c & 3)] =
                vertices.umbrella_of(v);
          });
    }
    surface_.vertex_count_ = vertices.umbrellas;
  }
  surface_.adjacency_ = adjacency;
  surface_.glue_ = glue;
  context.advance(1);
  return std::move(surface_);
}

}  // namespace dsc
