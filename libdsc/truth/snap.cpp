#include "libdsc/truth/snap.h"

#include "libdsc/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dsc::truth {

bool snap_to_surface(const ImplicitShape& shape, double reach, Vec3& q) {
  const double tolerance = 1e-12 * shape.bounds().diagonal().norm();
  const Vec3 start = q;
  Vec3 at = q;
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 60; ++k) {
    const Vec3 g = shape.gradient(at);
    const double gg = g.squaredNorm();
    if (!(gg > 0) || !std::isfinite(gg)) break;
    const double f = shape.value(at);
    const double distance = std::abs(f) / std::sqrt(gg);
    if (distance < best) {
      q = at;
      // Below the tolerance each step squares the error until only rounding is left.
    } else if (best <= tolerance) {
      break;
    }
    best = std::min(best, distance);
    if (f == 0) break;
    at -= g * (f / gg);
    if (!((at - start).norm() <= reach)) break;
  }
  if (best <= tolerance) return true;
  q = start;
  return false;
}

Index snap_to_surface(const ImplicitShape& shape, double reach, Index first,
                      Eigen::Matrix3Xd& points, const Context& context) {
  return parallel_reduce(
      context, points.cols() - first, 1024, Index{0},
      [&](Index begin, Index end) {
        Index failures = 0;
        for (Index i = first + begin; i < first + end; ++i) {
          Vec3 q = points.col(i);
          if (snap_to_surface(shape, reach, q)) {
            points.col(i) = q;
          } else {
            ++failures;
          }
        }
        return failures;
      },
      [](Index a, Index b) { return a + b; });
}

}  // namespace dsc::truth
