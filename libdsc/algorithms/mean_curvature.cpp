#include "libdsc/algorithms/mean_curvature.h"

#include "libdsc/base/error.h"

#include <string>
#include <utility>

namespace dsc {

MeanCurvature mean_curvature(const FlatMesh& mesh, Vec3View positions,
                             const LaplaceBeltramiOptions& options, const Context& context) {
  return mean_curvature(mesh, positions, vertex_normals(mesh, options.calculus, context), options,
                        context);
}

MeanCurvature mean_curvature(const FlatMesh& mesh, Vec3View positions, const VertexNormals& normals,
                             const LaplaceBeltramiOptions& options, const Context& context) {
  if (positions.size != mesh.vertices() || normals.u.cols() != mesh.vertices()) {
    throw UsageError("mean curvature: " + std::to_string(positions.size) + " positions and " +
                     std::to_string(normals.u.cols()) + " normals for " +
                     std::to_string(mesh.vertices()) + " vertices");
  }
  const LaplaceBeltrami laplacian(mesh, options, context);

  MeanCurvature result;
  result.undefined_vertices = normals.undefined;
  result.clamped_faces = laplacian.system().clamped_faces;
  result.mean = Eigen::VectorXd::Zero(mesh.vertices());
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::VectorXd x = positions.matrix().row(axis).transpose();
    result.mean -= 0.5 * laplacian.pointwise(x).cwiseProduct(normals.u.row(axis).transpose());
  }
  Solution smoothed = laplacian.smoothed(result.mean, context);
  result.mean = std::move(smoothed.x);
  result.relative_residual = smoothed.relative_residual;
  return result;
}

}  // namespace dsc
