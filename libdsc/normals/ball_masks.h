/// \file
/// (internal) The vector path of BallScanner: the rows of one kind of ball as masks for
/// ball_kernel.h.
#pragma once

#include "libdsc/normals/ball_kernel.h"
#include "libdsc/normals/ball_moments.h"

#include <memory>
#include <vector>

namespace dsc {

class BallMasks {
 public:
  /// Null where the machine has no kernel or the ball is wider than its registers (64 voxels along
  /// any axis): the plain scan serves.
  static std::unique_ptr<BallMasks> make(const BallRows& rows);

  /// The same integers as BallScanner::plain. Precondition: `centre` has the rows' parity.
  BallMoments moments(const BinaryVolume& volume, const Index3& centre) const;

 private:
  explicit BallMasks(const BallRows& rows);

  Index3 reach_;
  std::vector<std::uint64_t> masks_;
  std::vector<detail::BallStrip> strips_;
  std::vector<const detail::BallStrip*> first_strip_;  ///< by slice, and one past the end
};

}  // namespace dsc
