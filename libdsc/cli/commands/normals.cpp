#include "libdsc/base/parallel.h"
#include "libdsc/cli/commands/commands.h"
#include "libdsc/cli/known_answers.h"
#include "libdsc/cli/measured_shape.h"

#include <Eigen/Geometry>

#include <cmath>

namespace dsc::cli {
namespace {

/// The angles between estimated and exact normals, in radians, by a formula that is exact near 0.
Eigen::VectorXd angles(const Vec3View& estimated, const Eigen::Matrix3Xd& exact,
                       const Context& context) {
  Eigen::VectorXd result(estimated.size);
  parallel_for(context, estimated.size, 1 << 13, [&](Index first, Index last) {
    for (Index f = first; f < last; ++f) {
      const Vec3 u = estimated[f], v = exact.col(f);
      result[f] = std::atan2(u.cross(v).norm(), u.dot(v));
    }
  });
  return result;
}

void measure_error(const Scene& scene, Run& run) {
  const Stopwatch watch(run.report.timings.check);
  const ImplicitShape* shape = measured_shape(scene, run);
  if (shape == nullptr) return;
  const Eigen::Matrix3Xd centres = face_centres(scene.surface);
  const KnownVectors exact = known_normals(*shape, {centres.data(), centres.cols()}, run.context);
  const Eigen::VectorXd error = angles(scene.surface.normals(), exact.vectors, run.context);
  run.report.error_name = "angle to the exact normal, radians";
  run.report.error = error_norms(error, exact.known);
  warn_of_left_out(run);
}

}  // namespace

void run_normals(Run& run) {
  Scene scene = open_scene(run);
  estimate_normals(scene, run);

  if (run.options.estimator != Estimator::analytic) measure_error(scene, run);
  const FlatMesh mesh = scene.polygons ? scene.polygons->view() : scene.surface.flat();
  write_outputs(scene,
                {mesh, {vector_field("normal", {"nx", "ny", "nz"}, FieldOn::face, mesh.normals)}},
                run);
}

}  // namespace dsc::cli
