#include "libdsc/voxels/implicit_curvature.h"

#include "libdsc/base/tangent_eigen.h"

#include <cmath>

namespace dsc {

std::optional<ImplicitCurvature> implicit_curvature(const ImplicitShape& shape, const Vec3& p) {
  const Vec3 gradient = shape.gradient(p);
  const double slope = gradient.stableNorm();
  const Mat3 hessian = shape.hessian(p);
  // A slope that a step of the size of rounding would undo is none.
  const double scale = shape.bounds().diagonal().norm();
  if (!std::isfinite(slope) || !(slope > 1e-12 * scale * hessian.norm())) return std::nullopt;

  ImplicitCurvature c;
  c.normal = gradient / slope;
  const TangentEigen principal = tangent_eigen(hessian, c.normal);
  c.kappa_1 = principal.low / slope;
  c.kappa_2 = principal.high / slope;
  c.direction_1 = principal.low_direction;
  c.direction_2 = principal.high_direction;
  c.mean = 0.5 * (c.kappa_1 + c.kappa_2);
  c.gaussian = c.kappa_1 * c.kappa_2;
  return c;
}

}  // namespace dsc
