/// \file
/// \internal
/// A point near an implicit surface onto it, along the gradient: Newton on f alone,
///     q <- q - f grad f / |grad f|^2,
/// until rounding ends the descent of |f| / |grad f|. It reaches the surface, not the closest point
/// (that is projection.h), so it is for vertices that may slide by O(distance^2).
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/voxels/implicit_shape.h"

namespace dsc::truth {

/// Moves q; whether |f| / |grad f| <= 1e-12 L there, L the diagonal of shape.bounds(), with a way
/// no longer than `reach`.
bool snap_to_surface(const ImplicitShape& shape, double reach, Vec3& q);

/// Every column of `points` from `first` on, in parallel; the number that did not reach the surface
/// (they stay where they were).
Index snap_to_surface(const ImplicitShape& shape, double reach, Index first,
                      Eigen::Matrix3Xd& points, const Context& context = {});

}  // namespace dsc::truth
