#include "libdsc/base/tangent_eigen.h"

#include <Eigen/Geometry>

#include <cmath>

namespace dsc {

TangentEigen tangent_eigen(const Mat3& m, const Vec3& n) {
  const Vec3 s = n.unitOrthogonal();
  const Vec3 t = n.cross(s);
  const double ss = s.dot(m * s), tt = t.dot(m * t), st = s.dot(m * t);
  const double middle = 0.5 * (ss + tt);
  const double difference = 0.5 * (ss - tt);
  const double reach = std::hypot(difference, st);
  const double angle = 0.5 * std::atan2(st, difference);
  TangentEigen result;
  result.low = middle - reach;
  result.high = middle + reach;
  result.high_direction = std::cos(angle) * s + std::sin(angle) * t;
  result.low_direction = n.cross(result.high_direction);
  return result;
}

}  // namespace dsc
