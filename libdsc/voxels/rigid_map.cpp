#include "libdsc/voxels/rigid_map.h"

#include "libdsc/base/error.h"

#include <Eigen/LU>
#include <Eigen/SVD>

namespace dsc {

bool RigidMap::mirrors() const { return rotation.determinant() < 0; }

bool RigidMap::is_identity() const {
  return rotation == Mat3::Identity() && translation == Vec3::Zero();
}

RigidMap rigid_map(const Mat3& direction, const Vec3& origin) {
  if (!direction.allFinite() || !origin.allFinite()) {
    throw InputError("the image's direction and origin must be finite");
  }
  constexpr double kTolerance = 1e-3;
  const double off = (direction.transpose() * direction - Mat3::Identity()).cwiseAbs().maxCoeff();
  if (off > kTolerance) {
    throw InputError(
        "the image's axes are not at right angles, or its direction cosines not of unit length; "
        "resample it on a straight grid");
  }
  // As orthogonal as rounding leaves a product of rotations, or what is made below; lengths change
  // by half of it, no more than by applying the map. To make it anew would change bits for nothing.
  constexpr double kRounding = 1e-14;
  if (off <= kRounding) return {direction, origin};
  const Eigen::JacobiSVD<Mat3> svd(direction, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU() * svd.matrixV().transpose(), origin};
}

}  // namespace dsc
