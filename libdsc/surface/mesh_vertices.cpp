#include "libdsc/surface/mesh_vertices.h"

#include "libdsc/surface/umbrellas.h"

#include <algorithm>
#include <utility>

namespace dsc::topology {
namespace {

VertexId pointel(std::span<const QuadCorners> corners, SideCode corner) {
  return corners[static_cast<std::size_t>(face_of(corner))][static_cast<std::size_t>(corner & 3)];
}

/// Two sides that run the same way along a linel, so they are of two edges, both of which join the
/// umbrellas `from` and `to`.
struct ParallelEdges {
  SideCode x, y;
  VertexId from, to;
};

/// All of them; `umbrella_of(corner)` is the number of a corner's umbrella.
template <class UmbrellaOf>
std::vector<ParallelEdges> find_parallel_edges(std::span<const Junction> junctions,
                                               UmbrellaOf&& umbrella_of) {
  std::vector<ParallelEdges> found;
  for (const Junction& j : junctions) {
    for (std::size_t k = 0; k < 2; ++k) {
      const SideCode x = j.sides[k], y = j.sides[k + 2];
      if (x == kNoSide || y == kNoSide) continue;
      const VertexId from = umbrella_of(x);
      if (umbrella_of(y) != from) continue;
      const VertexId to = umbrella_of(next_side(x));
      if (umbrella_of(next_side(y)) == to) found.push_back({x, y, from, to});
    }
  }
  return found;
}

/// A corner, and the umbrella that it was of before that was split.
struct SplitCorner {
  SideCode corner;
  VertexId umbrella;
};

/// Links the edges the other way round. Returns corners of the umbrellas that were split, one of
/// each part at least.
std::vector<SplitCorner> separate(std::span<const ParallelEdges> edges,
                                  std::span<SideCode> opposite) {
  std::vector<SplitCorner> split;
  const auto same_umbrella = [&](SideCode a, SideCode b) {
    return leader_of(a, opposite) == leader_of(b, opposite);
  };
  const auto link = [&](SideCode side, SideCode partner) {
    opposite[static_cast<std::size_t>(side)] = partner;
    if (partner != kNoSide) opposite[static_cast<std::size_t>(partner)] = side;
  };
  for (const auto& [x, y, from, to] : edges) {
    // An earlier split may have parted these.
    if (!same_umbrella(x, y) || !same_umbrella(next_side(x), next_side(y))) continue;
    const SideCode partner_of_x = opposite[static_cast<std::size_t>(x)];
    const SideCode partner_of_y = opposite[static_cast<std::size_t>(y)];
    link(x, partner_of_y);
    link(y, partner_of_x);
    split.insert(split.end(), {{x, from}, {next_side(x), to}, {y, from}, {next_side(y), to}});
  }
  return split;
}

}  // namespace

MeshVertices number_mesh_vertices(std::span<const QuadCorners> corners, Index pointels,
                                  std::span<SideCode> opposite, std::span<const Junction> junctions,
                                  const Context& context) {
  MeshVertices result;
  Umbrellas umbrellas = find_umbrellas(corners, opposite, pointels, context);
  result.pointels = pointels;
  result.leaders = std::move(umbrellas.first);
  for (const SideCode leader : umbrellas.further) {
    const VertexId p = pointel(corners, leader);
    if (result.pointel_of.empty() || result.pointel_of.back() != p) ++result.pinched;
    result.leaders.push_back(leader);
    result.pointel_of.push_back(p);
  }
  result.umbrellas = static_cast<Index>(result.leaders.size());

  const auto umbrella_of = [&](SideCode corner) {
    const SideCode leader = leader_of(corner, opposite);
    const VertexId p = pointel(corners, corner);
    if (result.leaders[static_cast<std::size_t>(p)] == leader) return p;
    const auto& sorted = result.pointel_of;
    Index v = pointels + (std::lower_bound(sorted.begin(), sorted.end(), p) - sorted.begin());
    while (result.leaders[static_cast<std::size_t>(v)] != leader) ++v;
    return static_cast<VertexId>(v);
  };
  const std::vector<ParallelEdges> parallel = find_parallel_edges(junctions, umbrella_of);

  // Of the parts of a split umbrella, the one with its old leader keeps its number.
  std::vector<std::pair<VertexId, SideCode>> copies;
  for (const auto& [corner, umbrella] : separate(parallel, opposite)) {
    const SideCode kept = result.leaders[static_cast<std::size_t>(umbrella)];
    const SideCode leader = leader_of(corner, opposite);
    if (leader != leader_of(kept, opposite)) copies.emplace_back(umbrella, leader);
  }
  std::sort(copies.begin(), copies.end());
  copies.erase(std::unique(copies.begin(), copies.end()), copies.end());
  for (const auto& [umbrella, leader] : copies) {
    result.leaders.push_back(leader);
    result.pointel_of.push_back(pointel(corners, leader));
    result.umbrella_of_copy.push_back(umbrella);
  }
  return result;
}

}  // namespace dsc::topology
