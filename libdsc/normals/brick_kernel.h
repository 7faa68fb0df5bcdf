/// \file
/// \internal
/// The inner loops of BrickBall on AVX2.
#pragma once

#include "libdsc/normals/brick_volume.h"

namespace dsc::detail {

/// Whether this machine runs them: a precondition of the functions here.
bool has_brick_kernel();

/// brick_sums(bits & mask).
BrickSums masked_brick_sums(const BrickBits& bits, const BrickBits& mask);

/// 0, and what x, y, z move by: from the lowest voxel of a brick to that of the ball's centre.
using BrickOffset = std::array<std::int32_t, 4>;

/// A run of bricks along x that lie wholly in a ball; places from its centre's brick.
struct BrickRow {
  std::int32_t first, last;  ///< last is one past
  BrickOffset by;            ///< of the row; x is the ball's own
};

/// The bricks that a ball cuts.
struct CutBricks {
  std::size_t count;
  const std::int32_t* places;  ///< from its centre's brick
  const BrickOffset* by;
  const BrickBits* masks;
  const BrickSums* full;                 ///< moved sums of the mask
  std::int32_t *full_list, *mixed_list;  ///< room for count + 1
};

/// What the ball meets; each pointer is at the place of its centre's brick, mixed at the first.
struct BrickView {
  const std::int32_t* states;
  const BrickBits* mixed;
  const BrickSums* before;
};

/// As BrickSums, in 64 bits.
struct BallSums {
  std::array<std::int64_t, 4> first{}, square{}, cross{};
};

/// The sums over a ball, from the lowest voxel of its centre's brick; `x` is that voxel's, negated,
/// in the coordinates of `before`.
BallSums brick_ball_sums(const BrickRow* rows, std::size_t row_count, std::int32_t x,
                         const CutBricks& cut, const BrickView& view);

}  // namespace dsc::detail
