#include "libdsc/truth/true_geometry.h"

#include "libdsc/base/parallel.h"
#include "libdsc/voxels/implicit_curvature.h"

namespace dsc::truth {

TrueGeometry true_geometry(const ImplicitShape& shape, Vec3View points, const Context& context) {
  TrueGeometry result;
  result.normals.setZero(3, points.size);
  result.mean.setZero(points.size);
  result.gaussian.setZero(points.size);
  result.failures = parallel_reduce(
      context, points.size, 1024, Index{0},
      [&](Index first, Index last) {
        Index failures = 0;
        for (Index i = first; i < last; ++i) {
          if (const auto curvature = implicit_curvature(shape, points[i])) {
            result.normals.col(i) = curvature->normal;
            result.mean[i] = curvature->mean;
            result.gaussian[i] = curvature->gaussian;
          } else {
            ++failures;
          }
        }
        return failures;
      },
      [](Index a, Index b) { return a + b; });
  return result;
}

}  // namespace dsc::truth
