/// \file
/// \internal
/// The balls of one residue: those whose centres lie alike in their bricks.
///
/// Such balls meet the bricks around them alike. Bricks wholly inside are summed a row at a time
/// (BrickVolume::before). Of a cut one, a mask tells what is in the ball: where the brick is empty
/// there is nothing to do, where it is full the sums of the mask are known, and only where it is
/// mixed are voxels counted. A ball of radius R has π R² rows of voxels, but π R²/64 rows of bricks
/// and about 6 π R²/64 cut ones, and the surface crosses about π R/2 of these.
#pragma once

#include "libdsc/normals/ball_moments.h"
#include "libdsc/normals/brick_kernel.h"
#include "libdsc/normals/brick_volume.h"

#include <vector>

namespace dsc {

class BrickBall {
 public:
  /// Voxels. Second moments of a row of bricks are at most about 50 R³: 31 bits hold them, with
  /// room.
  static constexpr double kLargest = 200;

  /// `residue`: the centre in doubled coordinates from its brick's lowest voxel, in [0, 16); `rows`
  /// has its parity. Precondition: detail::has_brick_kernel().
  BrickBall(const BrickVolume& volume, const BallRows& rows, const Index3& residue);

  /// The same integers as BallScanner::plain for the ball centred in brick `centre` of the volume.
  /// Precondition: it does not reach beyond the bricks.
  BallMoments moments(const BrickVolume& volume, const Index3& centre);

 private:
  Index3 residue_;
  std::vector<detail::BrickRow> rows_;
  // The cut bricks, one entry each:
  std::vector<std::int32_t> places_;
  std::vector<detail::BrickOffset> by_;
  std::vector<BrickBits> masks_;
  std::vector<BrickSums> full_;  ///< of the mask, from the lowest voxel of the centre's brick
  // For moments(): the full and the mixed ones.
  std::vector<std::int32_t> full_list_, mixed_list_;
};

}  // namespace dsc
