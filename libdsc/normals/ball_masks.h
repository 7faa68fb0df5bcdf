/// \file
/// \internal
/// The vector path of BallScanner: the rows of one kind of ball as masks for
/// ball_kernel.h. A ball wider than the kernel's registers is cut into blocks.
#pragma once

#include "libdsc/normals/ball_kernel.h"
#include "libdsc/normals/ball_moments.h"

#include <memory>
#include <vector>

namespace dsc {

/// The part of a ball in a box of at most 64 voxels along any axis.
class BallBlock {
 public:
  /// `low` is the doubled offset of the box's first voxel from the ball's centre, `size` its extent
  /// in voxels.
  BallBlock(const BallRows& rows, const Index3& low, const Index3& size);

  // Strips point into masks_: a move keeps them, a copy would not.
  BallBlock(BallBlock&&) = default;
  BallBlock& operator=(BallBlock&&) = default;

  bool empty() const { return strips_.empty(); }
  /// The same integers as a plain scan of these voxels. Precondition: `centre` has the rows'
  /// parity.
  BallMoments moments(const BinaryVolume& volume, const Index3& centre) const;

 private:
  void add_slice(const BallRows& rows, Index dz, std::vector<std::size_t>& mask_at);

  Index3 low_;
  Index3 size_;
  std::vector<std::uint64_t> masks_;
  std::vector<detail::BallStrip> strips_;
  std::vector<const detail::BallStrip*> first_strip_;  ///< by slice, and one past the end
};

class BallMasks {
 public:
  /// Null where the machine has no kernel or the masks are too many: the plain scan serves.
  static std::unique_ptr<BallMasks> make(const BallRows& rows);

  /// The same integers as BallScanner::plain. Precondition: `centre` has the rows' parity.
  BallMoments moments(const BinaryVolume& volume, const Index3& centre) const;

 private:
  explicit BallMasks(const BallRows& rows);

  std::vector<BallBlock> blocks_;
};

}  // namespace dsc
