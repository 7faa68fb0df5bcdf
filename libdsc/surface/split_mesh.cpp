#include "libdsc/surface/split_mesh.h"

#include "libdsc/base/error.h"
#include "libdsc/surface/polygon_topology.h"

#include <algorithm>
#include <tuple>

namespace dsc {
namespace {

/// The faces that a halfedge mesh would refuse: with two corners at one umbrella, or with a side
/// that another face has in the same direction already.
std::vector<Index> unfit_faces(const FlatMesh& mesh, const std::vector<VertexId>& umbrellas) {
  struct DirectedSide {
    VertexId from, to;
    Index face;
    bool operator<(const DirectedSide& other) const {
      return std::tie(from, to, face) < std::tie(other.from, other.to, other.face);
    }
  };
  std::vector<Index> unfit;
  std::vector<DirectedSide> sides;
  sides.reserve(umbrellas.size());
  std::vector<VertexId> own;
  for (Index f = 0; f < mesh.faces(); ++f) {
    own.assign(umbrellas.begin() + mesh.first_corner(f),
               umbrellas.begin() + mesh.first_corner(f + 1));
    for (std::size_t i = 0; i < own.size(); ++i) {
      sides.push_back({own[i], own[(i + 1) % own.size()], f});
    }
    std::sort(own.begin(), own.end());
    if (std::adjacent_find(own.begin(), own.end()) != own.end()) unfit.push_back(f);
  }
  std::sort(sides.begin(), sides.end());
  for (std::size_t i = 1; i < sides.size(); ++i) {
    if (sides[i].from == sides[i - 1].from && sides[i].to == sides[i - 1].to) {
      unfit.push_back(sides[i].face);
    }
  }
  return unfit;
}

/// Umbrellas that a halfedge mesh can have as its vertices.
std::vector<VertexId> fitting_umbrellas(const FlatMesh& mesh) {
  std::vector<VertexId> links = linked_sides(mesh, SideLinks::opposed);
  for (;;) {
    std::vector<VertexId> umbrellas = corner_umbrellas(mesh, links);
    const std::vector<Index> unfit = unfit_faces(mesh, umbrellas);
    if (unfit.empty()) return umbrellas;
    // A face without links has umbrellas of its own, so that every round leaves fewer links.
    for (const Index f : unfit) {
      for (Index c = mesh.first_corner(f); c < mesh.first_corner(f + 1); ++c) {
        VertexId& link = links[static_cast<std::size_t>(c)];
        if (link >= 0) links[static_cast<std::size_t>(link)] = -1;
        link = -1;
      }
    }
  }
}

OpenMesh::Vec3d point_of(const Vec3& p) { return {p[0], p[1], p[2]}; }

}  // namespace

std::vector<VertexId> split_mesh(const FlatMesh& polygons, SurfaceMesh& mesh) {
  for (Index f = 0; f < polygons.faces(); ++f) {
    if (polygons.first_corner(f + 1) - polygons.first_corner(f) < 3) {
      throw InputError("face " + std::to_string(f) + " has fewer than 3 corners");
    }
  }
  const std::vector<VertexId> umbrellas = fitting_umbrellas(polygons);
  std::vector<VertexId> copied;
  for (Index v = 0; v < polygons.vertices(); ++v) {
    copied.push_back(static_cast<VertexId>(v));
    mesh.add_vertex(point_of(polygons.positions[v]));
  }
  // The mesh vertex of each umbrella, by its first corner; a vertex' first umbrella is itself.
  std::vector<VertexId> vertex_of(umbrellas.size(), -1);
  std::vector<bool> taken(copied.size(), false);
  std::vector<OpenMesh::VertexHandle> corners;
  for (Index f = 0; f < polygons.faces(); ++f) {
    corners.clear();
    for (Index c = polygons.first_corner(f); c < polygons.first_corner(f + 1); ++c) {
      const VertexId v = polygons.corners[static_cast<std::size_t>(c)];
      VertexId& own = vertex_of[static_cast<std::size_t>(umbrellas[static_cast<std::size_t>(c)])];
      if (own < 0 && !taken[static_cast<std::size_t>(v)]) {
        own = v;
        taken[static_cast<std::size_t>(v)] = true;
      } else if (own < 0) {
        own = mesh.add_vertex(point_of(polygons.positions[v])).idx();
        copied.push_back(v);
      }
      corners.emplace_back(own);
    }
    if (!mesh.add_face(corners).is_valid()) {
      throw InputError("face " + std::to_string(f) + " does not fit a halfedge mesh");
    }
  }
  return copied;
}

}  // namespace dsc
