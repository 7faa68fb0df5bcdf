/// \file
/// \internal
/// A part of a volume in bricks of 8³ voxels, for balls of many voxels.
///
/// A brick is empty, full or mixed; only mixed ones keep their bits. For every brick the sums over
/// those before it in its row along x are kept, so that any run of bricks costs two look-ups.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/voxels/binary_volume.h"

#include <array>
#include <cstdint>
#include <vector>

namespace dsc {

/// The 512 voxels of a brick: word z, byte y, bit x.
using BrickBits = std::array<std::uint64_t, 8>;

/// Sums over voxels, in lanes of four: what the vector loops add. Modulo 2^32: sums over long runs
/// may wrap around, their differences are right once they are taken relative to a near origin.
struct alignas(16) BrickSums {
  std::array<std::uint32_t, 4> first{};   ///< 1, x, y, z
  std::array<std::uint32_t, 4> square{};  ///< 0, xx, yy, zz
  std::array<std::uint32_t, 4> cross{};   ///< 0, xy, yz, zx

  BrickSums& operator+=(const BrickSums& other);
  friend bool operator==(const BrickSums&, const BrickSums&) = default;
};

/// The same voxels with x[a] counted from another origin: it becomes x[a] + by[a].
BrickSums moved(const BrickSums& sums, const Index3& by);

/// The sums over a brick, x, y and z counted from its lowest voxel.
BrickSums brick_sums(const BrickBits& bits);

class BrickVolume {
 public:
  static constexpr Index kEdge = 8;
  static constexpr std::int32_t kEmpty = 0, kFull = 1, kFirstMixed = 2;

  /// Bricks from the voxel `low` on, `size` of them along each axis; what lies outside the volume's
  /// grid is empty. \throws LimitError where there are 2^31 or more.
  BrickVolume(const BinaryVolume& volume, const Index3& low, const Index3& size,
              const Context& context = {});

  /// The place of brick (i, j, k).
  Index place(const Index3& brick) const {
    return brick[0] + strides_[1] * brick[1] + strides_[2] * brick[2];
  }

  /// kEmpty, kFull, or kFirstMixed + the place of its bits in mixed().
  const std::int32_t* states() const { return states_.data(); }
  const BrickBits* mixed() const { return mixed_.data(); }
  /// The sums over the bricks before this one in its row, x counted from `low`, y and z from the
  /// row's own lowest voxel.
  const BrickSums* before() const { return before_.data(); }

 private:
  Index3 strides_;
  std::vector<std::int32_t> states_;
  std::vector<BrickBits> mixed_;
  std::vector<BrickSums> before_;
};

}  // namespace dsc
