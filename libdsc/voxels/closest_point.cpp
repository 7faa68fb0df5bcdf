#include "libdsc/voxels/closest_point.h"

#include "libdsc/base/parallel.h"
#include "libdsc/voxels/shape_rows.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <utility>

namespace dsc {
namespace {

using Vec4 = Eigen::Vector4d;
using Mat4 = Eigen::Matrix4d;

/// Tolerances, as fractions of the shape's size.
constexpr double kOnSurface = 1e-12;
constexpr double kOptimal = 1e-9;
constexpr double kFarther = 1e-5;  // than the start, for Newton's answer to count

/// One search for the point of {f = 0} closest to p.
class Search {
 public:
  Search(const ImplicitShape& shape, const Vec3& p)
      : shape_(shape), p_(p), size_(shape.bounds().diagonal().norm()) {}

  ClosestPoint run() const {
    ClosestPoint best{p_, false};
    if (search_from(p_, best)) return best;
    // The gradient at p leads nowhere (a centre, a critical point), or by symmetry to a saddle:
    // start beside it, off every plane of symmetry.
    for (const double fraction : {1e-3, 1e-2, 1e-1}) {
      for (const Vec3& direction : {Vec3(0.48, 0.6, 0.64), Vec3(-0.36, 0.8, -0.48),
                                    Vec3(0.8, -0.36, -0.48), Vec3(-0.6, -0.48, 0.64)}) {
        if (search_from(p_ + fraction * size_ * direction, best)) return best;
      }
    }
    return best;
  }

  /// From `start` first; an answer from elsewhere counts only where it is as near.
  ClosestPoint run_from(const Vec3& start) const {
    ClosestPoint best{p_, false};
    if (search_from(start, best)) return best;
    const ClosestPoint other = run();
    Vec3 q = start;
    const bool as_near =
        reach_surface(q) && (other.point - p_).norm() <= (q - p_).norm() + kFarther * size_;
    return {other.point, other.converged && as_near};
  }

 private:
  /// Newton from the projection of `start`; where it ends at a saddle or farther away, a slide
  /// along the surface towards p and Newton again. Whether that converged; `best` holds what was
  /// reached.
  bool search_from(const Vec3& start, ClosestPoint& best) const {
    Vec3 q = start;
    if (!reach_surface(q)) return false;
    const double reached = (q - p_).norm();
    if (best.point == p_) best.point = q;
    for (int round = 0; round < 8; ++round) {
      const ClosestPoint next = accept(newton(q));
      if (next.converged && (next.point - p_).norm() <= reached + kFarther * size_) {
        best = next;
        return true;
      }
      if (!descend(q)) break;
      best.point = q;
    }
    return false;
  }

  /// First-order projection: q <- q - f grad f / |grad f|^2, a step no longer than a quarter of the
  /// size. Whether |f| / |grad f| became small.
  bool reach_surface(Vec3& q) const {
    for (int k = 0; k < 60; ++k) {
      const double f = shape_.value(q);
      if (f == 0) return true;
      const Vec3 g = shape_.gradient(q);
      const double gg = g.squaredNorm();
      if (!(gg > 0) || !std::isfinite(gg)) return false;
      Vec3 step = g * (-f / gg);
      const double length = step.norm();
      if (!std::isfinite(length)) return false;
      if (length > 0.25 * size_) step *= 0.25 * size_ / length;
      q += step;
      if (length <= 1e-6 * size_) return true;
    }
    return false;
  }

  /// The multiplier that fits best: mu = -(q - p).g / |g|^2.
  double multiplier(const Vec3& q, const Vec3& g) const {
    const double gg = g.squaredNorm();
    return gg > 0 ? -(q - p_).dot(g) / gg : 0.;
  }

  /// The residual in lengths: |q - p + mu g|^2 + (f / |g|)^2.
  double residual(const Vec3& q, double mu) const {
    const Vec3 g = shape_.gradient(q);
    const double f = shape_.value(q);
    const double gg = g.squaredNorm();
    if (!(gg > 0)) return std::numeric_limits<double>::infinity();
    return (q - p_ + mu * g).squaredNorm() + f * f / gg;
  }

  /// Newton with halved steps; ends when no step makes the residual smaller.
  Vec3 newton(Vec3 q) const {
    double mu = multiplier(q, shape_.gradient(q));
    double r = residual(q, mu);
    for (int k = 0; k < 40; ++k) {
      const Vec3 g = shape_.gradient(q);
      // Rows and columns of the multiplier are scaled by 1/|g|: both unknowns are lengths.
      const double scale = g.norm();
      if (!(scale > 0)) break;
      Mat4 jacobian = Mat4::Zero();
      jacobian.topLeftCorner<3, 3>() = Mat3::Identity() + mu * shape_.hessian(q);
      jacobian.topRightCorner<3, 1>() = g / scale;
      jacobian.bottomLeftCorner<1, 3>() = g.transpose() / scale;
      Vec4 rhs;
      rhs << q - p_ + mu * g, shape_.value(q) / scale;
      const Vec4 step = jacobian.fullPivLu().solve(-rhs);
      if (!step.allFinite()) break;
      const double before = r;
      for (double t = 1.; t > 1e-3; t *= 0.5) {
        const Vec3 next = q + t * step.head<3>();
        const double next_mu = mu + t * step[3] / scale;
        const double next_r = residual(next, next_mu);
        if (next_r < r) {
          q = next;
          mu = next_mu;
          r = next_r;
          break;
        }
      }
      // No step helped, or rounding is all that is left.
      if (r == before || (r > 0.25 * before && r < 1e-24 * size_ * size_)) break;
    }
    return q;
  }

  /// Gradient descent of |q - p|^2 along the surface, 30 steps; whether q moved.
  bool descend(Vec3& q) const {
    bool moved = false;
    double distance = (q - p_).squaredNorm();
    double t = 0.5;
    for (int k = 0; k < 30 && t > 1e-6; ++k) {
      const Vec3 g = shape_.gradient(q);
      const double gg = g.squaredNorm();
      if (!(gg > 0)) break;
      const Vec3 d = p_ - q;
      Vec3 next = q + t * (d - g * (d.dot(g) / gg));
      if (reach_surface(next) && (next - p_).squaredNorm() < distance) {
        distance = (next - p_).squaredNorm();
        q = next;
        moved = true;
      } else {
        t *= 0.5;
      }
    }
    return moved;
  }

  /// The conditions of the header.
  ClosestPoint accept(const Vec3& q) const {
    const Vec3 g = shape_.gradient(q);
    const double length = g.norm();
    if (!q.allFinite() || !(length > 0)) return {q, false};
    const Vec3 n = g / length;
    const Vec3 d = q - p_;
    if (std::abs(shape_.value(q)) / length > kOnSurface * size_) return {q, false};
    if ((d - n * d.dot(n)).norm() > kOptimal * size_) return {q, false};
    const Mat3 tangent = Mat3::Identity() - n * n.transpose();
    const Mat3 second = Mat3::Identity() + multiplier(q, g) * shape_.hessian(q);
    const Mat3 restricted = tangent * second * tangent + n * n.transpose();
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(restricted, Eigen::EigenvaluesOnly);
    return {q, eigen.eigenvalues()[0] >= -1e-6};
  }

  const ImplicitShape& shape_;
  const Vec3 p_;
  const double size_;
};

void check_finite(const Vec3& p) {
  if (!p.allFinite()) {
    throw InputError("closest point: the point (" + text_of(p.x()) + ", " + text_of(p.y()) + ", " +
                     text_of(p.z()) + ") is not finite");
  }
}

}  // namespace

ClosestPoint closest_point_by_newton(const ImplicitShape& shape, const Vec3& p) {
  check_finite(p);
  return Search(shape, p).run();
}

ClosestPoint closest_point_by_newton_from(const ImplicitShape& shape, const Vec3& p,
                                          const Vec3& start) {
  check_finite(p);
  check_finite(start);
  return Search(shape, p).run_from(start);
}

ClosestPoint closest_point(const ImplicitShape& shape, const Vec3& p) {
  check_finite(p);
  if (const std::optional<Vec3> exact = shape.closest_point_in_closed_form(p)) {
    return {*exact, true};
  }
  return Search(shape, p).run();
}

ProjectedPoints project_points(const ImplicitShape& shape, Vec3View points,
                               const Context& context) {
  context.need("project", 24 * points.size);
  context.begin("project", points.size);
  ProjectedPoints result;
  result.points.resize(3, points.size);
  result.failures = parallel_reduce(
      context, points.size, 1024, Index{0},
      [&](Index first, Index last) {
        Index failures = 0;
        for (Index i = first; i < last; ++i) {
          const ClosestPoint closest = closest_point(shape, points[i]);
          result.points.col(i) = closest.point;
          failures += closest.converged ? 0 : 1;
        }
        context.advance(last - first);
        return failures;
      },
      [](Index a, Index b) { return a + b; });
  return result;
}

}  // namespace dsc
