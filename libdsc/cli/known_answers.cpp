#include "libdsc/cli/known_answers.h"

#include "libdsc/base/parallel.h"
#include "libdsc/voxels/closest_point.h"
#include "libdsc/voxels/shapes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dsc::cli {
namespace {

constexpr Index kAnswerGrain = 1 << 12;

/// The distance between the radial projections of p and q.
double great_circle(const Sphere& sphere, const Vec3& p, const Vec3& q) {
  const Vec3 a = p - sphere.center();
  const Vec3 b = q - sphere.center();
  return sphere.radius() * std::atan2(a.cross(b).norm(), a.dot(b));
}

/// The distance between the orthogonal projections of p and q.
double straight_line(const Plane& plane, const Vec3& p, const Vec3& q) {
  const Vec3 d = q - p;
  return (d - plane.normal() * plane.normal().dot(d)).norm();
}

template <class Distance>
Eigen::VectorXd distances(Vec3View points, const Eigen::Matrix3Xd& sources,
                          const Distance& distance, const Context& context) {
  context.need("check", 3 * 8 * points.size);  // and the errors, and sorted
  context.begin("check", points.size);
  Eigen::VectorXd result(points.size);
  parallel_for(context, points.size, kAnswerGrain, [&](Index first, Index last) {
    for (Index i = first; i < last; ++i) {
      double least = std::numeric_limits<double>::infinity();
      for (Index s = 0; s < sources.cols(); ++s) {
        least = std::min(least, distance(points[i], Vec3(sources.col(s))));
      }
      result[i] = least;
    }
    context.advance(last - first);
  });
  return result;
}

/// Central differences; the step balances their error, of order step², against rounding.
Vec3 gradient_of(Expression::Evaluator& f, const Vec3& p) {
  constexpr double kStep = 1e-5;
  Vec3 g;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 low = p, high = p;
    const double step = kStep * std::max(1., std::abs(p[axis]));
    low[axis] -= step;
    high[axis] += step;
    g[axis] = (f(high) - f(low)) / (high[axis] - low[axis]);
  }
  return g;
}

/// make_value() makes a value(point of the shape, its normal) for one chunk.
template <class MakeValue>
KnownVectors at_closest_points(const ImplicitShape& shape, Vec3View points, const Context& context,
                               const MakeValue& make_value) {
  context.need("check", (24 + 1 + 2 * 8) * points.size);  // and the errors, and sorted
  context.begin("check", points.size);
  KnownVectors result;
  result.vectors = Eigen::Matrix3Xd::Zero(3, points.size);
  result.known.assign(static_cast<std::size_t>(points.size), 0);
  parallel_for(context, points.size, kAnswerGrain, [&](Index first, Index last) {
    auto value = make_value();
    for (Index i = first; i < last; ++i) {
      const ClosestPoint closest = closest_point(shape, points[i]);
      if (!closest.converged) continue;
      const Vec3 n = shape.gradient(closest.point).stableNormalized();
      if (!(n.squaredNorm() > 0.5)) continue;
      result.vectors.col(i) = value(closest.point, n);
      result.known[static_cast<std::size_t>(i)] = 1;
    }
    context.advance(last - first);
  });
  return result;
}

}  // namespace

std::optional<Eigen::VectorXd> known_distances(const ImplicitShape& shape, Vec3View points,
                                               const Eigen::Matrix3Xd& sources,
                                               const Context& context) {
  if (const auto* sphere = dynamic_cast<const Sphere*>(&shape)) {
    return distances(
        points, sources, [&](const Vec3& p, const Vec3& q) { return great_circle(*sphere, p, q); },
        context);
  }
  if (const auto* plane = dynamic_cast<const Plane*>(&shape)) {
    return distances(
        points, sources, [&](const Vec3& p, const Vec3& q) { return straight_line(*plane, p, q); },
        context);
  }
  return std::nullopt;
}

KnownVectors known_gradients(const ImplicitShape& shape, const Expression& f, Vec3View points,
                             const Context& context) {
  return at_closest_points(shape, points, context, [&f] {
    return [evaluate = Expression::Evaluator(f)](const Vec3& p, const Vec3& n) mutable -> Vec3 {
      const Vec3 g = gradient_of(evaluate, p);
      return g - n * n.dot(g);
    };
  });
}

KnownVectors known_normals(const ImplicitShape& shape, Vec3View points, const Context& context) {
  return at_closest_points(shape, points, context,
                           [] { return [](const Vec3&, const Vec3& n) { return n; }; });
}

}  // namespace dsc::cli
