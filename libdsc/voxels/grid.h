/// \file
/// The regular grid under every volume: voxel (i, j, k) is a cell centred on the lattice point
/// origin + spacing * (i, j, k), i in [0, size[0]) and so on.
#pragma once

#include "libdsc/base/checked.h"
#include "libdsc/base/types.h"

#include <string>

namespace dsc {

/// Size, spacing and place of a volume; the default has no voxel.
struct Grid {
  Index3 size{0, 0, 0};      ///< voxels along x, y, z
  Vec3 spacing{1., 1., 1.};  ///< edge lengths of a voxel, world units, all > 0
  Vec3 origin{0., 0., 0.};   ///< world position of the centre of voxel (0, 0, 0)

  /// \throws InputError on a negative size, a spacing that is not positive and finite, or an origin
  /// that is not finite; LimitError where an axis is longer than 2^40
  /// voxels or all voxels overflow 64 bits.
  void check() const;
  /// "512 x 512 x 300 voxels".
  std::string text() const;
  /// \throws LimitError on overflow.
  Index voxels() const {
    return checked_product(checked_product(size[0], size[1], "voxels"), size[2], "voxels");
  }
  /// Whether (x, y, z) is a voxel of the grid.
  bool contains(Index x, Index y, Index z) const {
    return x >= 0 && y >= 0 && z >= 0 && x < size[0] && y < size[1] && z < size[2];
  }
  /// World position of the lattice point (x, y, z); half-integers give surfel centres and pointels.
  Vec3 position(double x, double y, double z) const {
    return origin + spacing.cwiseProduct(Vec3(x, y, z));
  }
};

}  // namespace dsc
