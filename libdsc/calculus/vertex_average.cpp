#include "libdsc/calculus/vertex_average.h"

#include "libdsc/base/parallel.h"
#include "libdsc/calculus/mesh_checks.h"
#include "libdsc/calculus/polygon_kernel.h"
#include "libdsc/calculus/vertex_blocks.h"

#include <string>

namespace dsc {
namespace {

constexpr Index kAverageGrain = 4096;

/// Sums over the faces around each vertex of weight · value(face, u), k × V, and of the weights.
template <class Value>
void add_up(const FlatMesh& mesh, const CalculusOptions& options, const Context& context,
            Eigen::MatrixXd& sums, Eigen::VectorXd& weights, Value&& value) {
  const VertexBlocks blocks(mesh, context);
  blocks.run(context, [&](VertexId v0, VertexId v1, Index f0, Index f1) {
    const auto own = [&](VertexId v) { return v >= v0 && v < v1; };
    PolygonKernel kernel(mesh, options);
    for (Index f = f0; f < f1; ++f) {
      const auto ids = mesh.face(f);
      bool any = false;
      for (const VertexId v : ids) any = any || own(v);
      if (!any) continue;
      kernel.load(f);
      const double weight = kernel.area() / static_cast<double>(ids.size());
      for (const VertexId v : ids) {
        if (!own(v)) continue;
        weights[v] += weight;
        sums.col(v) += weight * value(f, kernel.normal());
      }
    }
  });
}

}  // namespace

Eigen::MatrixXd average_to_vertices(const FlatMesh& mesh,
                                    const Eigen::Ref<const Eigen::MatrixXd>& values,
                                    const CalculusOptions& options, const Context& context) {
  options.check();
  check_mesh(mesh, options);
  if (values.cols() != mesh.faces()) {
    throw UsageError(std::to_string(values.cols()) + " values for " + std::to_string(mesh.faces()) +
                     " faces");
  }
  for (Index f = 0; f < mesh.faces(); ++f) {
    if (!values.col(f).allFinite()) {
      throw InputError(face_name(mesh, f) + ": the value is not finite");
    }
  }
  context.begin("averages");
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(values.rows(), mesh.vertices());
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(mesh.vertices());
  add_up(mesh, options, context, sums, weights,
         [&](Index f, const Vec3&) { return values.col(f); });
  for (Index v = 0; v < mesh.vertices(); ++v) {
    if (weights[v] > 0) sums.col(v) /= weights[v];
  }
  return sums;
}

VertexNormals vertex_normals(const FlatMesh& mesh, const CalculusOptions& options,
                             const Context& context) {
  options.check();
  check_mesh(mesh, options);
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(3, mesh.vertices());
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(mesh.vertices());
  add_up(mesh, options, context, sums, weights, [](Index, const Vec3& u) { return u; });
  VertexNormals result;
  result.u = sums;
  result.undefined = parallel_reduce(
      context, mesh.vertices(), kAverageGrain, Index{0},
      [&](Index first, Index last) {
        Index undefined = 0;
        for (Index v = first; v < last; ++v) {
          const double length = result.u.col(v).norm();
          // Below this the direction is the rounding of normals that cancel.
          const bool defined = length > 1e-10 * weights[v];
          if (defined) {
            result.u.col(v) /= length;
          } else {
            result.u.col(v).setZero();
            ++undefined;
          }
        }
        return undefined;
      },
      [](Index a, Index b) { return a + b; });
  return result;
}

}  // namespace dsc
