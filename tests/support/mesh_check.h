/// \file
/// Whether a digital surface is a sound halfedge mesh: stricter than OpenMesh's own MeshChecker,
/// which accepts broken meshes.
#pragma once

#include "libdsc/surface/digital_surface.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace dsc::testing {

/// The empty string, or what is wrong first.
inline std::string mesh_fault(const DigitalSurface& surface) {
  const SurfaceMesh& mesh = surface.mesh();
  const auto say = [&](const std::string& what, int id) { return what + " " + std::to_string(id); };
  std::vector<std::size_t> outgoing(mesh.n_vertices(), 0);
  std::vector<std::pair<int, int>> joined;
  for (const auto h : mesh.halfedges()) {
    const auto from = mesh.from_vertex_handle(h), to = mesh.to_vertex_handle(h);
    if (!from.is_valid() || !to.is_valid() || from == to) return say("bad ends, halfedge", h.idx());
    const auto next = mesh.next_halfedge_handle(h);
    if (!next.is_valid() || mesh.from_vertex_handle(next) != to) {
      return say("next is elsewhere, halfedge", h.idx());
    }
    if (mesh.prev_halfedge_handle(next) != h) return say("prev(next) differs, halfedge", h.idx());
    if (mesh.face_handle(next) != mesh.face_handle(h)) {
      return say("next has another face, halfedge", h.idx());
    }
    const auto opposite = mesh.opposite_halfedge_handle(h);
    if (mesh.to_vertex_handle(opposite) != from) return say("opposite, halfedge", h.idx());
    if (mesh.is_boundary(h) && mesh.is_boundary(opposite)) {
      return say("edge without a face, halfedge", h.idx());
    }
    ++outgoing[static_cast<std::size_t>(from.idx())];
    joined.emplace_back(from.idx(), to.idx());
  }
  std::sort(joined.begin(), joined.end());
  const auto twice = std::adjacent_find(joined.begin(), joined.end());
  if (twice != joined.end()) return say("parallel edges from vertex", twice->first);
  for (const auto v : mesh.vertices()) {
    const auto start = mesh.halfedge_handle(v);
    if (!start.is_valid()) return say("isolated vertex", v.idx());
    std::size_t orbit = 0;
    int boundary = 0;
    auto h = start;
    do {
      if (++orbit > mesh.n_halfedges()) return say("orbit does not close, vertex", v.idx());
      if (mesh.from_vertex_handle(h) != v) return say("orbit leaves vertex", v.idx());
      boundary += mesh.is_boundary(h) ? 1 : 0;
      h = mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(h));
    } while (h != start);
    if (orbit != outgoing[static_cast<std::size_t>(v.idx())]) {
      return say("halfedges in several orbits, vertex", v.idx());
    }
    if (boundary > 1) return say("several boundaries at vertex", v.idx());
    if (boundary == 1 && !mesh.is_boundary(start))
      return say("boundary not first, vertex", v.idx());
  }
  OpenMesh::VPropHandleT<VertexId> ids;
  if (!mesh.get_property_handle(ids, property::kVertexId)) return "no vertex ids";
  for (const auto f : mesh.faces()) {
    int i = 0;
    const auto& corners = surface.corners()[static_cast<std::size_t>(f.idx())];
    auto h = mesh.halfedge_handle(f);
    do {
      if (i == 4) return say("not a quad, face", f.idx());
      const auto v = mesh.from_vertex_handle(h);
      const VertexId id = corners[static_cast<std::size_t>(i++)];
      if (id < 0 || id >= surface.vertex_count())
        return say("vertex id out of range, face", f.idx());
      if (mesh.property(ids, v) != id) return say("side table and mesh disagree, face", f.idx());
      if ((mesh.points()[id] - mesh.point(v)).norm() != 0)
        return say("moved corner, face", f.idx());
      h = mesh.next_halfedge_handle(h);
    } while (h != mesh.halfedge_handle(f));
    if (i != 4) return say("not a quad, face", f.idx());
  }
  return {};
}

}  // namespace dsc::testing
