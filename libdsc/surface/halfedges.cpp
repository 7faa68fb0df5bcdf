#include "libdsc/surface/halfedges.h"

#include "libdsc/base/parallel.h"
#include "libdsc/surface/umbrellas.h"

#include <memory>
#include <vector>

namespace dsc::topology {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

void write_halfedges(SurfaceMesh& mesh, std::span<const QuadCorners> corners,
                     std::span<const SideCode> opposite, std::span<const SideCode> leaders,
                     Index pointels, const Context& context) {
  constexpr Index kGrain = 8192;
  const auto faces = static_cast<Index>(corners.size());
  const auto at = [](auto& array, SideCode s) -> decltype(auto) {
    return array[static_cast<std::size_t>(s)];
  };
  // An edge belongs to the first of its sides; edges are numbered in the order of these.
  const auto owns = [&](SideCode s) { return at(opposite, s) == kNoSide || s < at(opposite, s); };
  std::vector<Index> edge_base(static_cast<std::size_t>((faces + kGrain - 1) / kGrain) + 1, 0);
  parallel_for(context, faces, kGrain, [&](Index first, Index last) {
    Index edges = 0;
    for (SideCode s = side_code(first, 0); s < side_code(last, 0); ++s) edges += owns(s) ? 1 : 0;
    edge_base[static_cast<std::size_t>(first / kGrain) + 1] = edges;
  });
  for (std::size_t c = 1; c < edge_base.size(); ++c) edge_base[c] += edge_base[c - 1];

  mesh.resize(leaders.size(), static_cast<std::size_t>(edge_base.back()), corners.size());
  const auto halfedge = std::make_unique_for_overwrite<int[]>(opposite.size());
  parallel_for(context, faces, kGrain, [&](Index first, Index last) {
    auto edge = static_cast<int>(edge_base[static_cast<std::size_t>(first / kGrain)]);
    for (SideCode s = side_code(first, 0); s < side_code(last, 0); ++s) {
      if (!owns(s)) continue;
      at(halfedge, s) = 2 * edge;
      if (at(opposite, s) != kNoSide) at(halfedge, at(opposite, s)) = 2 * edge + 1;
      ++edge;
    }
  });

  const auto handle = [&](SideCode s) { return HalfedgeHandle(at(halfedge, s)); };
  const auto outside = [&](SideCode s) { return HalfedgeHandle(at(halfedge, s) ^ 1); };
  const auto vertex = [&](SideCode s) {
    return VertexHandle(
        corners[static_cast<std::size_t>(face_of(s))][static_cast<std::size_t>(s & 3)]);
  };
  parallel_for(context, faces, kGrain, [&](Index first, Index last) {
    for (Index f = first; f < last; ++f) {
      const FaceHandle face(static_cast<int>(f));
      mesh.set_halfedge_handle(face, handle(side_code(f, 0)));
      for (int i = 0; i < 4; ++i) {
        const SideCode s = side_code(f, i);
        mesh.set_vertex_handle(handle(s), vertex(next_side(s)));
        mesh.set_face_handle(handle(s), face);
        mesh.set_next_halfedge_handle(handle(s), handle(next_side(s)));
        if (at(opposite, s) != kNoSide) continue;
        // The boundary halfedge runs back to corner i; the boundary goes on from the start of the
        // chain of corners that ends here.
        SideCode start = s;
        while (previous_around(start, opposite) != kNoSide)
          start = previous_around(start, opposite);
        mesh.set_vertex_handle(outside(s), vertex(s));
        mesh.set_boundary(outside(s));
        mesh.set_next_halfedge_handle(outside(s), outside(previous_side(start)));
      }
    }
  });
  // The vertices that share their pointel with another.
  const Index further = static_cast<Index>(leaders.size()) - pointels;
  parallel_for(context, further, kGrain, [&](Index first, Index last) {
    for (Index v = pointels + first; v < pointels + last; ++v) {
      const VertexHandle name(static_cast<int>(v));
      for_each_around(leaders[static_cast<std::size_t>(v)], opposite, [&](SideCode corner) {
        mesh.set_vertex_handle(handle(previous_side(corner)), name);
        if (at(opposite, corner) == kNoSide) mesh.set_vertex_handle(outside(corner), name);
      });
    }
  });
  parallel_for(context, static_cast<Index>(leaders.size()), kGrain, [&](Index first, Index last) {
    for (Index v = first; v < last; ++v) {
      const SideCode leader = leaders[static_cast<std::size_t>(v)];
      const SideCode before = previous_side(leader);
      const bool open = at(opposite, before) == kNoSide;
      mesh.set_halfedge_handle(VertexHandle(static_cast<int>(v)),
                               open ? outside(before) : handle(leader));
    }
  });
}

}  // namespace dsc::topology
