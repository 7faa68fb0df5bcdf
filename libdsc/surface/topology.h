/// \file
/// \internal
/// How surfels meet: the corners and sides of the six kinds of surfel, as tables.
///
/// Side i of a face runs from corner i to corner i + 1 along a linel; it faces an in-plane
/// direction. A side of a face of the mesh is named by its code 4 * face + i.
#pragma once

#include "libdsc/surface/surfel.h"

#include <array>
#include <cstdint>

namespace dsc::topology {

using SideCode = std::int32_t;
inline constexpr SideCode kNoSide = -1;

constexpr SideCode side_code(Index face, int side) {
  return static_cast<SideCode>(4 * face + side);
}
constexpr Index face_of(SideCode s) { return s >> 2; }
constexpr SideCode next_side(SideCode s) { return (s & ~3) | ((s + 1) & 3); }
constexpr SideCode previous_side(SideCode s) { return (s & ~3) | ((s + 3) & 3); }

/// The opposite of direction d (2 * axis + positive).
constexpr int opposite_direction(int d) { return d ^ 1; }

/// The unit step of each direction.
inline constexpr int kStep[6][3] = {{-1, 0, 0}, {1, 0, 0},  {0, -1, 0},
                                    {0, 1, 0},  {0, 0, -1}, {0, 0, 1}};

struct Voxel {
  Index x, y, z;
  constexpr Voxel step(int d) const { return {x + kStep[d][0], y + kStep[d][1], z + kStep[d][2]}; }
};

/// kSideDirection[d][i]: the in-plane direction that side i of a surfel of direction d faces.
inline constexpr auto kSideDirection = [] {
  std::array<std::array<int, 4>, 6> table{};
  for (int d = 0; d < 6; ++d) {
    const auto [a, b] = kSurfelFrames[d];
    table[d] = {2 * b, 2 * a + 1, 2 * b + 1, 2 * a};
  }
  return table;
}();

/// kSideFacing[d][e]: the side of a surfel of direction d that faces direction e, or -1.
inline constexpr auto kSideFacing = [] {
  std::array<std::array<int, 6>, 6> table{};
  for (auto& row : table) row = {-1, -1, -1, -1, -1, -1};
  for (int d = 0; d < 6; ++d) {
    for (int i = 0; i < 4; ++i) table[d][kSideDirection[d][i]] = i;
  }
  return table;
}();

/// kCornerOffset[d][i]: corner i of the surfel of inner voxel (x, y, z) is the pointel
/// (x, y, z) + offset; pointel (i, j, k) is the low corner of voxel (i, j, k).
inline constexpr auto kCornerOffset = [] {
  std::array<std::array<std::array<int, 3>, 4>, 6> table{};
  for (int d = 0; d < 6; ++d) {
    const auto [a, b] = kSurfelFrames[d];
    for (int i = 0; i < 4; ++i) {
      auto& offset = table[d][i];
      offset = {0, 0, 0};
      offset[d >> 1] = d & 1;
      offset[a] = (i == 1 || i == 2) ? 1 : 0;
      offset[b] = (i == 2 || i == 3) ? 1 : 0;
    }
  }
  return table;
}();

/// The surfels that meet at a linel that is no ordinary edge: more than two, or two that cannot be
/// linked. In the order a, b, c, d around the linel, absent ones kNoSide. Where all four separate
/// the same two labels, (a, b) and (c, d) share their inner voxel, (a, d) and (c, b) their outer
/// one, and a and c run along the linel one way, b and d the other.
struct Junction {
  std::array<SideCode, 4> sides;
};

}  // namespace dsc::topology
