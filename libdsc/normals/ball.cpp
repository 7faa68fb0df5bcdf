#include "libdsc/normals/ball.h"

#include "libdsc/base/error.h"

#include <cmath>
#include <string>

namespace dsc {
namespace {

/// The largest d >= 0 with inside(d) and d = parity mod 2, or -1; inside is monotone.
template <class Inside>
Index largest(double guess, Index parity, Inside inside) {
  Index d = static_cast<Index>(guess);
  if ((d & 1) != parity) ++d;
  while (inside(d + 2)) d += 2;
  while (d >= 0 && !inside(d)) d -= 2;
  return d < 0 ? -1 : d;
}

}  // namespace

Ball::Ball(double radius, const Vec3& spacing) : radius_(radius), spacing_(spacing) {
  if (!(radius > 0) || !std::isfinite(radius)) {
    throw UsageError("ball: the radius must be positive and finite, not " + std::to_string(radius));
  }
  if (!(spacing.minCoeff() > 0) || !spacing.allFinite()) {
    throw UsageError("ball: the spacing must be positive and finite");
  }
  const double h = spacing.maxCoeff();
  weight_ = (spacing / h).array().square();
  const double voxels = radius / h;
  limit_ = 4. * (voxels * voxels) * (1. + 0x1p-40);

  // Before anything integral: at most prod(reach + 1) points, each adding at most reach^2.
  const Vec3 bound = (limit_ / weight_.array()).sqrt() + 1.;
  const double widest = bound.maxCoeff();
  if (!(bound.prod() * widest * widest < 0x1p62)) {
    throw LimitError("ball: a radius of " + std::to_string(radius / spacing.minCoeff()) +
                     " voxels overflows 64-bit moments; use a smaller radius or a coarser grid");
  }
  for (int axis = 0; axis < 3; ++axis) {
    const auto inside = [&](Index d) {
      return contains(axis == 0 ? d : 0, axis == 1 ? d : 0, axis == 2 ? d : 0);
    };
    Index& reach = reach_[static_cast<std::size_t>(axis)];
    reach = std::max(largest(bound[axis], 0, inside), largest(bound[axis], 1, inside));
  }
}

bool Ball::contains(Index dx, Index dy, Index dz) const {
  const auto term = [this](int axis, Index d) {
    return weight_[axis] * (static_cast<double>(d) * static_cast<double>(d));
  };
  const double across = term(1, dy) + term(2, dz);
  return term(0, dx) + across <= limit_;
}

BallRows::BallRows(const Ball& ball, const Index3& parity) : parity_(parity) {
  const auto of_parity = [&](std::size_t axis) {
    const Index reach = ball.reach(static_cast<int>(axis));
    return (reach & 1) == parity[axis] ? reach : reach - 1;
  };
  const Index last_y = of_parity(1);
  const Index last_z = of_parity(2);
  if (last_y < 0 || last_z < 0) return;
  columns_ = (last_y >> 1) + 1;
  extents_.reserve(static_cast<std::size_t>(columns_ * ((last_z >> 1) + 1)));
  for (Index dz = parity[2]; dz <= last_z; dz += 2) {
    Index guess = ball.reach(0);
    for (Index dy = parity[1]; dy <= last_y; dy += 2) {
      const Index extent = largest(static_cast<double>(std::max<Index>(guess, 0)), parity[0],
                                   [&](Index dx) { return ball.contains(dx, dy, dz); });
      extents_.push_back(static_cast<std::int32_t>(extent));
      guess = extent;
      if (extent >= 0) {
        reach_[0] = std::max(reach_[0], extent);
        reach_[1] = std::max(reach_[1], dy);
        reach_[2] = std::max(reach_[2], dz);
      }
    }
  }
}

}  // namespace dsc
