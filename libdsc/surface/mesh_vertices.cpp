#include "libdsc/surface/mesh_vertices.h"

#include "libdsc/surface/umbrellas.h"

#include <algorithm>
#include <utility>

namespace dsc::topology {
namespace {

template <class Corners>
auto& entry(Corners& corners, SideCode corner) {
  return corners[static_cast<std::size_t>(face_of(corner))][static_cast<std::size_t>(corner & 3)];
}

/// Returns corners of the umbrellas that were split, one of each part at least.
std::vector<SideCode> separate_parallel_edges(std::vector<SideCode>& opposite,
                                              std::span<const Junction> junctions) {
  std::vector<SideCode> split;
  const auto same_umbrella = [&](SideCode a, SideCode b) {
    return leader_of(a, opposite) == leader_of(b, opposite);
  };
  const auto link = [&](SideCode side, SideCode partner) {
    opposite[static_cast<std::size_t>(side)] = partner;
    if (partner != kNoSide) opposite[static_cast<std::size_t>(partner)] = side;
  };
  for (const Junction& j : junctions) {
    for (std::size_t k = 0; k < 2; ++k) {
      // Two sides that run the same way along the linel, so they are of two edges.
      const SideCode x = j.sides[k], y = j.sides[k + 2];
      if (x == kNoSide || y == kNoSide) continue;
      if (!same_umbrella(x, y) || !same_umbrella(next_side(x), next_side(y))) continue;
      const SideCode partner_of_x = opposite[static_cast<std::size_t>(x)];
      const SideCode partner_of_y = opposite[static_cast<std::size_t>(y)];
      link(x, partner_of_y);
      link(y, partner_of_x);
      split.insert(split.end(), {x, next_side(x), y, next_side(y)});
    }
  }
  return split;
}

}  // namespace

MeshVertices number_mesh_vertices(std::span<const QuadCorners> corners, Index pointels,
                                  std::vector<SideCode>& opposite,
                                  std::span<const Junction> junctions, const Context& context) {
  MeshVertices result;
  Umbrellas umbrellas = find_umbrellas(corners, opposite, pointels, context);
  result.pointels = pointels;
  result.leaders = std::move(umbrellas.first);
  const auto name = [&](SideCode leader, std::size_t id) {
    if (result.corners.empty()) result.corners.assign(corners.begin(), corners.end());
    for_each_around(leader, opposite,
                    [&](SideCode c) { entry(result.corners, c) = static_cast<VertexId>(id); });
  };
  for (const SideCode leader : umbrellas.further) {
    const VertexId pointel = entry(corners, leader);
    if (result.pointel_of.empty() || result.pointel_of.back() != pointel) ++result.pinched;
    name(leader, result.leaders.size());
    result.leaders.push_back(leader);
    result.pointel_of.push_back(pointel);
  }
  result.umbrellas = static_cast<Index>(result.leaders.size());
  result.umbrella_corners = result.corners;

  // Of the parts of a split umbrella, the one with its old leader keeps its number.
  std::vector<std::pair<VertexId, SideCode>> copies;
  for (const SideCode corner : separate_parallel_edges(opposite, junctions)) {
    const VertexId umbrella = result.umbrella_corners.empty()
                                  ? entry(corners, corner)
                                  : entry(result.umbrella_corners, corner);
    const SideCode kept = result.leaders[static_cast<std::size_t>(umbrella)];
    const SideCode leader = leader_of(corner, opposite);
    if (leader != leader_of(kept, opposite)) copies.emplace_back(umbrella, leader);
  }
  std::sort(copies.begin(), copies.end());
  copies.erase(std::unique(copies.begin(), copies.end()), copies.end());
  for (const auto& [umbrella, leader] : copies) {
    name(leader, result.leaders.size());
    result.leaders.push_back(leader);
    result.pointel_of.push_back(entry(corners, leader));
    result.umbrella_of_copy.push_back(umbrella);
  }
  return result;
}

}  // namespace dsc::topology
