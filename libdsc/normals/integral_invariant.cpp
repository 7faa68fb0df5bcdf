#include "libdsc/normals/integral_invariant.h"

#include "libdsc/base/checked.h"
#include "libdsc/base/parallel.h"
#include "libdsc/normals/smallest_eigenvector.h"

#include <cmath>

namespace dsc {
namespace {

constexpr Index kGrain = 256;          // balls a chunk: well below a second even for large ones
constexpr double kRightAngle = 1e-10;  // |cos| below which the orientation is rounding

/// u of one surfel, or zero where the balls do not tell.
Vec3 flattest_direction(std::span<const BallMoments> balls, const Vec3& spacing,
                        const Vec3& outward) {
  Mat3 v = Mat3::Zero();
  for (const BallMoments& ball : balls) v += covariance(ball, spacing);  // the scale is immaterial
  const SmallestEigenvector smallest = smallest_eigenvector(v);
  if (!smallest.unique) return Vec3::Zero();
  const double cosine = smallest.u.dot(outward);
  if (std::abs(cosine) < kRightAngle) return Vec3::Zero();
  return cosine > 0 ? smallest.u : Vec3(-smallest.u);
}

}  // namespace

void visit_balls(const BinaryVolume& volume, std::span<const Surfel> surfels,
                 const IntegralInvariantOptions& options, const BallVisitor& visit,
                 const Context& context) {
  const bool pair = options.centre == BallCentre::voxel_pair;
  using Centres = BallScanner::Centres;
  const BallScanner scan(volume, options.radius, pair ? Centres::voxels : Centres::surfels);
  parallel_for(context, static_cast<Index>(surfels.size()), kGrain, [&](Index first, Index last) {
    for (Index i = first; i < last; ++i) {
      const Surfel& s = surfels[static_cast<std::size_t>(i)];
      Index3 centre{2 * Index{s.x}, 2 * Index{s.y}, 2 * Index{s.z}};
      Index& along = centre[static_cast<std::size_t>(s.axis())];
      BallMoments balls[2];
      if (pair) {
        balls[0] = scan(centre);
        along += 2 * s.sign();
        balls[1] = scan(centre);
      } else {
        along += s.sign();
        balls[0] = scan(centre);
      }
      visit(i, std::span(balls, pair ? 2 : 1));
    }
    context.advance(last - first);
  });
}

NormalField integral_invariant_normals(const BinaryVolume& volume, std::span<const Surfel> surfels,
                                       const IntegralInvariantOptions& options,
                                       const Context& context) {
  const Index n = static_cast<Index>(surfels.size());
  context.begin("normals", n);
  NormalField field;
  field.radius = options.radius;
  field.u.resize(3, n);
  const Vec3 spacing = volume.grid().spacing;
  visit_balls(
      volume, surfels, options,
      [&](Index i, std::span<const BallMoments> balls) {
        const Vec3 outward = surfels[static_cast<std::size_t>(i)].normal();
        field.u.col(i) = flattest_direction(balls, spacing, outward);
      },
      context);
  // A second pass replaces and counts: visitors share no counter.
  field.fallbacks = parallel_reduce(
      context, n, 1 << 16, Index{0},
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
  return field;
}

}  // namespace dsc
