/// \file
/// Exact curvatures of an implicit surface {f = 0}, from f's derivatives.
///
/// With n = grad f / |grad f|, outwards, the shape operator is (I - n n^T) Hess f (I - n n^T) /
/// |grad f| on the tangent plane; its eigenvalues are the principal curvatures. They are positive
/// where the solid {f < 0} is convex: a ball of radius r has 1/r, 1/r.
#pragma once

#include "libdsc/base/types.h"
#include "libdsc/voxels/implicit_shape.h"

#include <optional>

namespace dsc {

/// Curvatures, their directions and the normal at one point.
struct ImplicitCurvature {
  double mean = 0;                   ///< (kappa_1 + kappa_2) / 2, 1 / length
  double gaussian = 0;               ///< kappa_1 kappa_2
  double kappa_1 = 0;                ///< the smaller one
  double kappa_2 = 0;                ///< the larger one
  Vec3 direction_1 = Vec3::UnitX();  ///< unit tangents, their signs arbitrary; any orthonormal pair
  Vec3 direction_2 = Vec3::UnitY();  ///< where kappa_1 = kappa_2
  Vec3 normal = Vec3::UnitZ();       ///< unit, outwards
};

/// At `p`, which is taken to lie on the surface (see closest_point.h); elsewhere, the curvatures of
/// the level set through it. Nothing where the gradient vanishes, so that there is no tangent
/// plane. \throws InputError where an expression cannot be evaluated.
std::optional<ImplicitCurvature> implicit_curvature(const ImplicitShape& shape, const Vec3& p);

}  // namespace dsc
