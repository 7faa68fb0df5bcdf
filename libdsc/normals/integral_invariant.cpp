#include "libdsc/normals/integral_invariant.h"

#include "libdsc/base/checked.h"
#include "libdsc/base/parallel.h"
#include "libdsc/normals/brick_scan.h"
#include "libdsc/normals/flattest_direction.h"

namespace dsc {
namespace {

constexpr Index kBallGrain = 256;  // balls a chunk: well below a second even for large ones

}  // namespace

Index visit_balls(const BinaryVolume& volume, std::span<const Surfel> surfels,
                  const IntegralInvariantOptions& options, const BallVisitor& visit,
                  const Context& context) {
  const bool pair = options.centre == BallCentre::voxel_pair;
  const bool continued = options.beyond == Beyond::continued;
  const Ball ball(options.radius, volume.grid().spacing);
  if (!pair && !continued && bricks_pay(ball, surfels)) {
    brick_scan(
        volume, ball, surfels,
        [&](Index i, const BallMoments& moments) {
          visit(i, {&moments, 1});
        },
        context);
    return 0;
  }
  using Centres = BallScanner::Centres;
  const BallScanner scan(volume, options.radius, pair ? Centres::voxels : Centres::surfels);
  const auto moments = [&](const Index3& centre, bool& cut) {
    if (!continued) return scan(centre);
    bool this_one = false;
    BallMoments m = scan.continued(centre, this_one);
    cut = cut || this_one;
    return m;
  };
  const auto some = [&](Index first, Index last) {
    Index cut_surfels = 0;
    for (Index i = first; i < last; ++i) {
      const Surfel& s = surfels[static_cast<std::size_t>(i)];
      Index3 centre{2 * Index{s.x}, 2 * Index{s.y}, 2 * Index{s.z}};
      Index& along = centre[static_cast<std::size_t>(s.axis())];
      BallMoments balls[2];
      bool cut = false;
      if (pair) {
        balls[0] = moments(centre, cut);
        along += 2 * s.sign();
        balls[1] = moments(centre, cut);
      } else {
        along += s.sign();
        balls[0] = moments(centre, cut);
      }
      cut_surfels += cut ? 1 : 0;
      visit(i, std::span(balls, pair ? 2 : 1));
    }
    context.advance(last - first);
    return cut_surfels;
  };
  return parallel_reduce(context, static_cast<Index>(surfels.size()), kBallGrain, Index{0}, some,
                         [](Index a, Index b) { return a + b; });
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
  field.cut_faces = visit_balls(
      volume, surfels, options,
      [&](Index i, std::span<const BallMoments> balls) {
        Mat3 v = Mat3::Zero();  // of a pair the sum: the scale is immaterial
        for (const BallMoments& ball : balls) v += covariance(ball, spacing);
        field.u.col(i) = flattest_direction(v, surfels[static_cast<std::size_t>(i)].normal());
      },
      context);
  fall_back(field, surfels, context);  // a second pass: visitors share no counter
  return field;
}

}  // namespace dsc
