#include "libdsc/truth/projection.h"

#include "libdsc/base/parallel.h"

namespace dsc::truth {

ClosestPoint SurfaceProjection::closest(const Vec3& p) const {
  return closest_point_by_newton_from(*shape_, p, tree_.closest(p).point);
}

ProjectedPoints SurfaceProjection::project(Vec3View points, const Context& context) const {
  ProjectedPoints result;
  result.points.resize(3, points.size);
  context.begin("project", points.size);
  result.failures = parallel_reduce(
      context, points.size, 1024, Index{0},
      [&](Index first, Index last) {
        Index failures = 0;
        for (Index i = first; i < last; ++i) {
          const ClosestPoint found = closest(points[i]);
          result.points.col(i) = found.point;
          failures += found.converged ? 0 : 1;
        }
        context.advance(last - first);
        return failures;
      },
      [](Index a, Index b) { return a + b; });
  return result;
}

}  // namespace dsc::truth
