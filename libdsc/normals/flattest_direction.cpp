#include "libdsc/normals/flattest_direction.h"

#include "libdsc/base/parallel.h"
#include "libdsc/normals/smallest_eigenvector.h"

#include <cmath>

namespace dsc {
namespace {

constexpr double kRightAngle = 1e-10;  // |cos| below which the orientation is rounding

}  // namespace

Vec3 flattest_direction(const Mat3& v, const Vec3& outward) {
  const SmallestEigenvector smallest = smallest_eigenvector(v);
  if (!smallest.unique) return Vec3::Zero();
  const double cosine = smallest.u.dot(outward);
  if (std::abs(cosine) < kRightAngle) return Vec3::Zero();
  return cosine > 0 ? smallest.u : Vec3(-smallest.u);
}

void fall_back(NormalField& field, std::span<const Surfel> surfels, const Context& context) {
  field.fallbacks = parallel_reduce(
      context, static_cast<Index>(surfels.size()), 1 << 16, Index{0},
      [&](Index first, Index last) {
        Index count = 0;
        for (Index i = first; i < last; ++i) {
          if (!field.u.col(i).isZero(0)) continue;
          field.u.col(i) = surfels[static_cast<std::size_t>(i)].normal();
          ++count;
        }
        return count;
      },
      [](Index a, Index b) { return a + b; });
}

}  // namespace dsc
