/// \file
/// The place of a volume in the world: p -> rotation p + translation.
///
/// Everything is computed in the frame of the volume, where voxel (i, j, k) is at origin + spacing
/// * (i, j, k). A scanner's image lies turned in the world, and perhaps mirrored; the map takes
/// positions from the one frame to the other and keeps all lengths.
#pragma once

#include "libdsc/base/types.h"

namespace dsc {

/// A rotation, possibly with a reflection, and a translation; the identity by default.
struct RigidMap {
  Mat3 rotation = Mat3::Identity();  ///< orthogonal; of determinant -1 where the map mirrors
  Vec3 translation = Vec3::Zero();   ///< world units

  /// The world position of p.
  Vec3 operator()(const Vec3& p) const { return rotation * p + translation; }
  /// The position whose world position is q.
  Vec3 inverse(const Vec3& q) const { return rotation.transpose() * (q - translation); }
  /// A direction: normals and gradients.
  Vec3 turned(const Vec3& v) const { return rotation * v; }

  /// A face's corners then run the other way around its outward normal.
  bool mirrors() const;
  /// Whether it leaves every position as it is, to the last bit.
  bool is_identity() const;
};

/// The map of an image's direction cosines (columns: the world directions of its axes) and origin.
/// Files store cosines rounded; the rotation is the orthogonal matrix closest to them, and they
/// themselves, to the last bit, where no entry of their product with their transpose is off by more
/// than 1e-14: what the map has given is given back.
/// \throws InputError where they are not finite or off an orthogonal matrix by more than 1e-3.
RigidMap rigid_map(const Mat3& direction, const Vec3& origin);

}  // namespace dsc
