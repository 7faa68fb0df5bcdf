#include "libdsc/surface/surface_builder.h"

#include "libdsc/base/checked.h"
#include "libdsc/base/parallel.h"
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

/// Two edges a face, of two halfedges each.
Index edge_bytes(Index faces) { return 2 * 2 * 16 * faces; }

/// What finish() takes beside both: a halfedge a side in a list; a vertex its set, its leader, its
/// id.
Index linked_bytes(Index vertices, Index faces) { return (4 + 4 + 4) * vertices + 4 * 4 * faces; }

/// The same for `further` vertices that share a pointel: leader, pointel, umbrella, id and
/// position. Where they are more than there is room for, the positions of all others move.
Index split_bytes(Index vertices, Index further) {
  return (3 * 4 + 4 + 24) * further + (further > vertices / 16 ? (24 + 4) * vertices : 0);
}

}  // namespace

SurfaceBuilder::SurfaceBuilder(const Grid& grid, Index vertices, Index faces, bool with_labels,
                               bool whole, const Context& context)
    : whole_(whole) {
  (void)checked_id(checked_product(8, faces, "surface halfedges"), "surface halfedges");
  (void)checked_id(vertices, "surface vertices");
  context.need("extract",
               filled_bytes(vertices, faces, with_labels) + (whole ? edge_bytes(faces) : 0));
  surface_.grid_ = grid;
  surface_.vertex_count_ = vertices;
  SurfaceMesh& mesh = surface_.mesh();
  if (with_labels) mesh.add_property(surface_.labels_, property::kLabels);
  // A few more vertices or edges are common, and would move all the others.
  const auto V = static_cast<std::size_t>(vertices), F = static_cast<std::size_t>(faces);
  mesh.reserve(V + V / 16, whole ? 2 * F + F / 16 : 0, F);
  // The first touch of memory is slow, so that each array gets a thread.
  parallel_for(context, 4, 1, [&](Index array, Index) {
    if (array == 0) mesh.property(mesh.points_property_handle()).data_vector().resize(V);
    if (array == 1) mesh.property(surface_.corners_).data_vector().resize(F);
    if (array == 2) mesh.property(surface_.surfels_).data_vector().resize(F);
    if (array == 3 && with_labels) mesh.property(surface_.labels_).data_vector().resize(F);
  });
  mesh.resize(V, 0, F);
  opposite_ =
      std::make_unique_for_overwrite<topology::SideCode[]>(static_cast<std::size_t>(4 * faces));
}

void SurfaceBuilder::make_edges() {
  SurfaceMesh& mesh = surface_.mesh();
  if (whole_) mesh.resize(mesh.n_vertices(), 2 * mesh.n_faces(), mesh.n_faces());
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
  const auto faces = static_cast<Index>(surfels().size());
  context.need("link", linked_bytes(pointels, faces) + (whole_ ? 0 : edge_bytes(faces)));
  SurfaceCounts& counts = surface_.counts_;
  counts = topology::count_glued(corners(), pointels, opposite(), junctions_, labels(), context);
  context.advance(1);
  const topology::MeshVertices vertices =
      topology::number_mesh_vertices(corners(), pointels, opposite(), junctions_, context);
  counts.pinched_vertices = vertices.pinched;
  context.need("link",
               split_bytes(pointels, static_cast<Index>(vertices.leaders.size()) - pointels));
  context.advance(1);

  SurfaceMesh& mesh = surface_.mesh();
  topology::write_halfedges(mesh, corners(), opposite(), vertices.leaders, pointels, context);
  const auto points = positions();
  OpenMesh::VPropHandleT<VertexId> ids;
  mesh.add_property(ids, property::kVertexId);
  parallel_for(context, static_cast<Index>(points.size()), 65536, [&](Index first, Index last) {
    for (Index v = first; v < last; ++v) {
      auto id = static_cast<VertexId>(v);
      if (v >= pointels) {
        const VertexId pointel = vertices.pointel_of[static_cast<std::size_t>(v - pointels)];
        points[static_cast<std::size_t>(v)] = points[static_cast<std::size_t>(pointel)];
        id = glue == Glue::pointel ? pointel : vertices.umbrella_of(v);
      }
      mesh.property(ids, OpenMesh::VertexHandle(static_cast<int>(v))) = id;
    }
  });
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
