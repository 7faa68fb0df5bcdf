#include "libdsc/cli/known_curvatures.h"

#include "libdsc/base/parallel.h"
#include "libdsc/voxels/expression_shape.h"

namespace dsc::cli {
namespace {

constexpr Index kCurvatureGrain = 1 << 10;

/// value(i) for every i, in parallel.
template <class Value>
std::vector<Value> collect(Index n, const Context& context, auto&& value) {
  constexpr Index kErrors = 3 * sizeof(double);  // of one of them, and sorted
  context.need("check", (static_cast<Index>(sizeof(Value)) + kErrors) * n);
  context.begin("check", n);
  std::vector<Value> all(static_cast<std::size_t>(n));
  parallel_for(context, n, kCurvatureGrain, [&](Index first, Index last) {
    for (Index i = first; i < last; ++i) all[static_cast<std::size_t>(i)] = value(i);
    context.advance(last - first);
  });
  return all;
}

}  // namespace

std::vector<std::optional<ImplicitCurvature>> known_curvatures(const ImplicitShape& shape,
                                                               Vec3View points,
                                                               const Context& context) {
  return collect<std::optional<ImplicitCurvature>>(
      points.size, context, [&](Index i) { return implicit_curvature(shape, points[i]); });
}

std::vector<std::optional<double>> known_laplacians(const ImplicitShape& shape, const Expression& f,
                                                    Vec3View points, const Context& context) {
  const ExpressionShape function(f.text(), shape.bounds(), true);
  return collect<std::optional<double>>(
      points.size, context, [&](Index i) -> std::optional<double> {
        const std::optional<ImplicitCurvature> c = implicit_curvature(shape, points[i]);
        if (!c) return std::nullopt;
        const Vec3 gradient = function.gradient(points[i]);
        const Mat3 hessian = function.hessian(points[i]);
        return hessian.trace() - c->normal.dot(hessian * c->normal) -
               2. * c->mean * c->normal.dot(gradient);
      });
}

}  // namespace dsc::cli
