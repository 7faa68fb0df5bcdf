#include "libdsc/normals/analytic.h"

#include "libdsc/base/parallel.h"
#include "libdsc/voxels/closest_point.h"

namespace dsc {

NormalField analytic_normals(const ImplicitShape& shape, const Grid& grid,
                             std::span<const Surfel> surfels, const Context& context) {
  constexpr Index kGrain = 1024;
  const Index n = static_cast<Index>(surfels.size());
  context.begin("normals", n);
  NormalField field;
  field.u.resize(3, n);
  field.fallbacks = parallel_reduce(
      context, n, kGrain, Index{0},
      [&](Index first, Index last) {
        Index fallbacks = 0;
        for (Index i = first; i < last; ++i) {
          const Surfel& surfel = surfels[static_cast<std::size_t>(i)];
          const ClosestPoint closest = closest_point(shape, surfel.centre(grid));
          Vec3 u = Vec3::Zero();
          if (closest.converged) u = shape.gradient(closest.point).stableNormalized();
          if (!u.allFinite() || !(u.squaredNorm() > 0.5)) {
            u = surfel.normal();
            ++fallbacks;
          }
          field.u.col(i) = u;
        }
        context.advance(last - first);
        return fallbacks;
      },
      [](Index a, Index b) { return a + b; });
  return field;
}

}  // namespace dsc
