/// \file
/// \internal
/// Where the cells around a surfel lie, as tables.
#pragma once

#include "libdsc/surface/cell_neighbourhood.h"
#include "libdsc/surface/topology.h"

#include <array>

namespace dsc::topology {

/// A cell near a surfel, from the voxel above the surfel (cell_neighbourhood.h).
struct Place {
  int axis = 0;  ///< of a surfel
  int dx = 0;
  int row = 0;
};
/// Of a surfel: its corners, and around each side the three other surfels of the linel.
struct Places {
  std::array<Place, 4> corners;
  /// For a corner with dx = 1, the one with dx = 0 in its row.
  std::array<std::size_t, 4> before{};
  std::array<std::array<Place, 3>, 4> beside;
};

/// By the direction of the surfel.
inline constexpr auto kPlaces = [] {
  const auto place = [](int axis, const Voxel& v) {
    return Place{axis, static_cast<int>(v.x),
                 CellNeighbourhood::row(static_cast<int>(v.y), static_cast<int>(v.z))};
  };
  std::array<Places, 6> table{};
  for (int d = 0; d < 6; ++d) {
    const bool up = (d & 1) != 0;
    const Voxel upper{0, 0, 0};
    const Voxel inner = up ? upper.step(d - 1) : upper, outer = inner.step(d);
    Places& places = table[static_cast<std::size_t>(d)];
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& o = kCornerOffset[static_cast<std::size_t>(d)][i];
      places.corners[i] = place(0, {inner.x + o[0], inner.y + o[1], inner.z + o[2]});
      const int e = kSideDirection[static_cast<std::size_t>(d)][i];
      const auto across = [&](const Voxel& v) {
        return place(e >> 1, (e & 1) != 0 ? v.step(e) : v);
      };
      places.beside[i] = {across(inner), place(d >> 1, upper.step(e)), across(outer)};
    }
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        const Place &low = places.corners[j], &high = places.corners[i];
        if (low.row == high.row && low.dx < high.dx) places.before[i] = j;
      }
    }
  }
  return table;
}();

}  // namespace dsc::topology
