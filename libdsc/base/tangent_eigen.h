/// \file
/// Eigenvalues and directions of a symmetric matrix restricted to a plane: of a shape operator, of
/// a covariance's tangential part.
#pragma once

#include "libdsc/base/types.h"

namespace dsc {

/// Of the quadratic form of M on the vectors across n: its extremes and where they are attained.
struct TangentEigen {
  double low = 0;                       ///< the least value on unit vectors
  double high = 0;                      ///< the greatest
  Vec3 low_direction = Vec3::UnitX();   ///< unit, across n, its sign arbitrary
  Vec3 high_direction = Vec3::UnitY();  ///< across n and low_direction
};

/// M symmetric and finite, n a unit vector. Where low = high every direction attains them, and some
/// orthonormal pair is returned. Closed form; the values err by a few roundings of M's largest
/// entry.
TangentEigen tangent_eigen(const Mat3& m, const Vec3& n);

}  // namespace dsc
