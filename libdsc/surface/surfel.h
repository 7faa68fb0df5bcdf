/// \file
/// A surfel: the unit square between an inner voxel and one of its six neighbours.
#pragma once

#include "libdsc/base/types.h"
#include "libdsc/voxels/grid.h"

#include <cstdint>

namespace dsc {

/// The square between voxel (x, y, z), on its inside, and that voxel's neighbour in `direction`.
struct Surfel {
  /// The inner voxel.
  /// @{
  std::int32_t x = 0, y = 0, z = 0;
  /// @}

  /// 2 * axis + (1 where the outward normal points along +axis, 0 where along -axis).
  std::int32_t direction = 0;

  /// 0, 1 or 2: the axis across the square.
  int axis() const { return direction >> 1; }
  /// 1 where the outward normal points along +axis, else -1.
  int sign() const { return (direction & 1) != 0 ? 1 : -1; }
  /// The outward unit normal e of the square itself (not the estimated one).
  Vec3 normal() const {
    Vec3 e = Vec3::Zero();
    e[axis()] = sign();
    return e;
  }
  /// World position of the square's centre.
  Vec3 centre(const Grid& grid) const {
    Vec3 p(x, y, z);
    p[axis()] += 0.5 * sign();
    return grid.position(p[0], p[1], p[2]);
  }
  friend bool operator==(const Surfel&, const Surfel&) = default;
};

/// The in-plane frame of each direction: corner 0 of a face lies at the low end of both axes
/// `first` and `second`, and the corners follow 00, 10, 11, 01 in (first, second). The order is
/// counter-clockwise seen from outside: first x second is the outward normal.
struct SurfelFrame {
  int first;   ///< axis, 0 to 2
  int second;  ///< axis, 0 to 2
};
/// By Surfel::direction.
inline constexpr SurfelFrame kSurfelFrames[6] = {
    {2, 1},  // -x: z x y = -x
    {1, 2},  // +x: y x z = +x
    {0, 2},  // -y: x x z = -y
    {2, 0},  // +y: z x x = +y
    {1, 0},  // -z: y x x = -z
    {0, 1},  // +z: x x y = +z
};

}  // namespace dsc
