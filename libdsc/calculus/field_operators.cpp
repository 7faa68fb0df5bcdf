#include "libdsc/calculus/field_operators.h"

#include "libdsc/base/parallel.h"
#include "libdsc/calculus/mesh_checks.h"
#include "libdsc/calculus/polygon_kernel.h"
#include "libdsc/calculus/surfel_operators.h"
#include "libdsc/calculus/vertex_blocks.h"

#include <cmath>
#include <string>

namespace dsc {
namespace {

constexpr Index kFieldGrain = 4096;

/// The surfels of a mesh, face by face, checked.
class Surfels {
 public:
  Surfels(const FlatMesh& mesh, const CalculusOptions& options)
      : mesh_(mesh), min_cosine_(options.min_cosine), shapes_(surfel_shapes(mesh.spacing)) {}

  SurfelOperators operator()(Index f) const {
    const int direction = mesh_.surfels[static_cast<std::size_t>(f)].direction;
    if (direction < 0 || direction > 5) refuse_direction(mesh_, f);
    const SurfelShape& shape = shapes_[static_cast<std::size_t>(direction)];
    if (!mesh_.has_normals()) return SurfelOperators(shape);
    const Vec3 u = mesh_.normals[f];
    if (!is_unit(u)) refuse_normal(mesh_, f);
    return {shape, u, min_cosine_};
  }

 private:
  const FlatMesh& mesh_;
  double min_cosine_;
  std::array<SurfelShape, 6> shapes_;
};

}  // namespace

Eigen::Matrix3Xd face_gradients(const FlatMesh& mesh, const Eigen::VectorXd& phi,
                                const CalculusOptions& options, const Context& context) {
  options.check();
  check_mesh(mesh, options);
  if (phi.size() != mesh.vertices()) {
    throw UsageError("the function has " + std::to_string(phi.size()) + " values for " +
                     std::to_string(mesh.vertices()) + " vertices");
  }
  Eigen::Matrix3Xd gradients(3, mesh.faces());
  context.begin("gradient", mesh.faces());
  const Surfels surfels(mesh, options);
  parallel_for(context, mesh.faces(), kFieldGrain, [&](Index first, Index last) {
    PolygonKernel kernel(mesh, options);
    for (Index f = first; f < last; ++f) {
      const auto ids = mesh.face(f);
      for (const VertexId v : ids) {
        check_vertex(mesh, f, v);
        if (!std::isfinite(phi[v])) {
          throw InputError(face_name(mesh, f) + ": the function is not finite at vertex " +
                           std::to_string(v));
        }
      }
      if (mesh.is_digital()) {
        gradients.col(f) = surfels(f).gradient(phi[ids[0]], phi[ids[1]], phi[ids[2]], phi[ids[3]]);
        continue;
      }
      kernel.load(f);
      // Relative to one corner's value: a large constant costs no digits.
      Vec3 sum = Vec3::Zero();
      for (std::size_t j = 1; j < ids.size(); ++j) {
        sum += (phi[ids[j]] - phi[ids[0]]) * kernel.chord(static_cast<Index>(j));
      }
      gradients.col(f) = sum.cross(kernel.normal()) / (2. * kernel.area());
    }
    context.advance(last - first);
  });
  return gradients;
}

Eigen::VectorXd integrated_divergence(const FlatMesh& mesh, const Eigen::Matrix3Xd& vectors,
                                      const CalculusOptions& options, const Context& context) {
  options.check();
  check_mesh(mesh, options);
  if (vectors.cols() != mesh.faces()) {
    throw UsageError(std::to_string(vectors.cols()) + " vectors for " +
                     std::to_string(mesh.faces()) + " faces");
  }
  Eigen::VectorXd divergence = Eigen::VectorXd::Zero(mesh.vertices());
  context.begin("divergence");
  const VertexBlocks blocks(mesh, context);
  const Surfels surfels(mesh, options);
  blocks.run(context, [&](VertexId v0, VertexId v1, Index f0, Index f1) {
    const auto own = [&](VertexId v) { return v >= v0 && v < v1; };
    PolygonKernel kernel(mesh, options);
    for (Index f = f0; f < f1; ++f) {
      const auto ids = mesh.face(f);
      bool any = false;
      for (const VertexId v : ids) any = any || own(v);
      if (!any) continue;
      if (!vectors.col(f).allFinite()) {
        throw InputError(face_name(mesh, f) + ": the vector is not finite");
      }
      if (mesh.is_digital()) {
        const std::array<double, 4> part = surfels(f).divergence(vectors.col(f));
        for (std::size_t i = 0; i < 4; ++i) {
          if (own(ids[i])) divergence[ids[i]] += part[i];
        }
        continue;
      }
      kernel.load(f);
      const Vec3 turned = 0.5 * kernel.normal().cross(vectors.col(f));
      for (std::size_t i = 0; i < ids.size(); ++i) {
        if (own(ids[i])) divergence[ids[i]] -= kernel.chord(static_cast<Index>(i)).dot(turned);
      }
    }
  });
  return divergence;
}

}  // namespace dsc
