/// \file
/// The closest point of an implicit surface {f = 0}, by Newton's method on the optimality system
/// \f[ q - p + \mu\,\nabla f(q) = 0, \quad f(q) = 0 \quad \mbox{in } (q, \mu). \f]
///
/// Steps of first-order projection, q <- q - f grad f / |grad f|^2, give the start; a line search
/// on the residual and, where Newton ends elsewhere, a descent along the surface keep it in hand. A
/// point is accepted only if
///     |f(q)| / |grad f(q)|                           <= 1e-12 L   (L the diagonal of bounds()),
///     the tangential part of q - p                   <= 1e-9 L,
///     and (I + mu Hess f) is positive semi-definite on the tangent plane: a local minimum.
/// It is then a local minimum no farther than the start; for p within the reach of the surface, as
/// the pointels of a digitization at a fine gridstep are, it is the closest point.
/// Closed forms (sphere, plane, torus) are used where there are.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/base/types.h"
#include "libdsc/voxels/implicit_shape.h"

namespace dsc {

/// What the search ends at.
struct ClosestPoint {
  Vec3 point;              ///< the best found; p itself where nothing was
  bool converged = false;  ///< whether the conditions above hold
};

/// \throws InputError where p is not finite or an expression cannot be evaluated on the way.
ClosestPoint closest_point(const ImplicitShape& shape, const Vec3& p);

/// The same by Newton alone, also for shapes with a closed form. For tests and comparisons.
ClosestPoint closest_point_by_newton(const ImplicitShape& shape, const Vec3& p);

/// Newton from `start`, a point near the surface: the answer is no farther from p than `start`
/// moved onto the surface, up to 1e-5 L. Where the start is near the closest point of another
/// branch than the one Newton finds from p, this finds that one. \throws as above.
ClosestPoint closest_point_by_newton_from(const ImplicitShape& shape, const Vec3& p,
                                          const Vec3& start);

/// The closest points of many.
struct ProjectedPoints {
  Eigen::Matrix3Xd points;  ///< column i is the closest point of point i
  Index failures = 0;       ///< points that did not converge; they hold the best point found
};

/// closest_point of every point, in parallel.
ProjectedPoints project_points(const ImplicitShape& shape, Vec3View points,
                               const Context& context = {});

}  // namespace dsc
