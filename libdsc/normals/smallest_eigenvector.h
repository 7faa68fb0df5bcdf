/// \file
/// \internal
/// The eigenvector of the smallest eigenvalue of a covariance matrix.
#pragma once

#include "libdsc/base/types.h"

namespace dsc {

struct SmallestEigenvector {
  Vec3 u = Vec3::Zero();  ///< unit, its sign arbitrary; zero where not unique
  bool unique = false;    ///< the smallest eigenvalue is simple, beyond rounding
};

/// For a symmetric positive semi-definite V with finite entries; its scale does not matter.
///
/// The error of u is a few roundings times trace / gap, gap the distance to the next eigenvalue:
/// what any backward stable solver gives. Not unique where the gap is below 1e-10 of the trace, so
/// for V = 0, for points on a line and for balls in a ball.
SmallestEigenvector smallest_eigenvector(const Mat3& v);

}  // namespace dsc
