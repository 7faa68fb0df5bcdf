#include "libdsc/cli/smooth_surface.h"

#include "libdsc/algorithms/regularise.h"
#include "libdsc/base/error.h"
#include "libdsc/cli/measured_shape.h"
#include "libdsc/voxels/closest_point.h"

namespace dsc::cli {
namespace {

Eigen::Matrix3Xd project(const ImplicitShape& shape, Vec3View points, const char* what, Run& run) {
  ProjectedPoints projected = project_points(shape, points, run.context);
  if (projected.failures > 0) {
    run.warn("the closest point of the shape was not found for " +
             std::to_string(projected.failures) + " of " + std::to_string(points.size) + " " +
             what);
  }
  return std::move(projected.points);
}

}  // namespace

SmoothSurface smooth_surface(const Scene& scene, Run& run) {
  const bool voxels = !scene.input.shape && !scene.polygons;
  if (voxels && run.options.projected) return regularised_surface(scene, run);
  const Stopwatch watch(run.report.timings.smooth);
  SmoothSurface smooth;
  smooth.mesh = flat_mesh(scene, run);
  if (scene.input.shape) {
    smooth.positions = project_vertices(scene, run);
    run.report.positions = PositionsReport{"projected", {}, {}, {}};
  } else {
    smooth.positions = scene.positions().matrix();
    run.report.positions = PositionsReport{voxels ? "pointels" : "as given", {}, {}, {}};
  }
  return smooth;
}

SmoothSurface regularised_surface(const Scene& scene, Run& run) {
  const Stopwatch watch(run.report.timings.smooth);
  const FlatMesh flat = scene.polygons ? scene.polygons->view() : scene.surface.flat();
  if (!flat.has_normals()) {
    throw InputError("'" + run.options.input + "' has no face normals to regularise by");
  }
  RegularisedPositions regular = regularise_positions(flat, {}, run.context);
  SmoothSurface smooth;
  smooth.positions = std::move(regular.positions);
  smooth.mesh.positions = smooth.points();
  smooth.mesh.corners = flat.corners;
  smooth.mesh.offsets = flat.offsets;
  run.report.positions = PositionsReport{"regularised", regular.mean_displacement,
                                         regular.largest_displacement, regular.iterations};
  return smooth;
}

Eigen::Matrix3Xd project_vertices(const Scene& scene, Run& run) {
  return project(*scene.input.shape, scene.surface.positions(), "vertices", run);
}

Eigen::Matrix3Xd project_face_centres(const Scene& scene, Run& run) {
  const Eigen::Matrix3Xd centres = face_centres(scene.surface);
  return project(*scene.input.shape, {centres.data(), centres.cols()}, "faces", run);
}

Eigen::VectorXd sample(const Expression& f, Vec3View points, const Scene& scene, const Run& run) {
  const RigidMap& world = scene.input.world;
  if (world.is_identity()) return f(points, run.context);
  Eigen::Matrix3Xd placed(3, points.size);
  for (Index i = 0; i < points.size; ++i) placed.col(i) = world(points[i]);
  return f({placed.data(), placed.cols()}, run.context);
}

}  // namespace dsc::cli
