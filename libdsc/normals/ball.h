/// \file
/// The lattice points in a ball of the world, counted in doubled coordinates.
///
/// A ball is centred on a voxel, or on a surfel: half-way between two voxels along one axis. In
/// doubled coordinates both are integers C, and the lattice point p lies at the integer offset d =
/// 2p - C. Where the spacing differs by axis the ball is round in the world, not in voxels.
#pragma once

#include "libdsc/base/types.h"

#include <vector>

namespace dsc {

/// Which lattice points a ball of the world has, whatever its centre.
class Ball {
 public:
  /// The ball of world radius `radius` on a grid of that spacing.
  /// \throws UsageError unless radius and spacing are positive and finite; LimitError where the
  /// second moments of a full ball could pass 64 bits (beyond about 3 000 voxels).
  Ball(double radius, const Vec3& spacing);

  /// Whether a lattice point at doubled offset (dx, dy, dz) from the centre is in the closed ball.
  ///
  /// The one definition that everything agrees with: wx dx^2 + (wy dy^2 + wz dz^2) <= T, in double,
  /// w_a = (h_a/h)^2, h the largest spacing, T = 4 (r/h)^2 (1 + 2^-40). With equal spacings every
  /// term is an exact integer and this is |d|^2 <= floor(T). The factor makes r = 6h include the
  /// points at distance 6h however r was rounded.
  bool contains(Index dx, Index dy, Index dz) const;

  /// The largest |d| along the axis at which a point on that axis is in the ball.
  Index reach(int axis) const { return reach_[static_cast<std::size_t>(axis)]; }
  /// World units.
  double radius() const { return radius_; }
  /// Of the grid, world units.
  const Vec3& spacing() const { return spacing_; }

 private:
  double radius_;
  Vec3 spacing_;
  Vec3 weight_;
  double limit_;
  Index3 reach_;
};

/// The rows along x of a ball whose centre has the given parity (C_a mod 2).
class BallRows {
 public:
  /// `parity`: 0 or 1 per axis, 1 along at most one for voxels and surfels.
  BallRows(const Ball& ball, const Index3& parity);

  /// As given.
  const Index3& parity() const { return parity_; }
  /// The largest |d| along the axis over the whole ball, of the right parity; -1 where it is empty.
  Index reach(int axis) const { return reach_[static_cast<std::size_t>(axis)]; }
  /// The largest |dx| in row (dy, dz), of the right parity; -1 where the row is empty.
  /// Precondition: dy, dz of the right parity and within reach.
  Index extent(Index dy, Index dz) const {
    const Index y = (dy < 0 ? -dy : dy) >> 1;
    const Index z = (dz < 0 ? -dz : dz) >> 1;
    return extents_[static_cast<std::size_t>(z * columns_ + y)];
  }

 private:
  Index3 parity_;
  Index3 reach_{-1, -1, -1};
  Index columns_ = 0;
  std::vector<std::int32_t> extents_;  ///< by (|dz|/2, |dy|/2)
};

}  // namespace dsc
