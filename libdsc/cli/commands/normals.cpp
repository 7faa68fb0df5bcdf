#include "libdsc/base/parallel.h"
#include "libdsc/cli/commands/commands.h"
#include "libdsc/cli/stages.h"
#include "libdsc/normals/analytic.h"

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

}  // namespace

void run_normals(Run& run) {
  Scene scene = open_scene(run);
  estimate_normals(scene, run);

  const DigitalSurface& surface = scene.surface;
  if (scene.input.shape && run.options.estimator != Estimator::analytic) {
    const NormalField exact =
        analytic_normals(*scene.input.shape, surface.grid(), surface.surfels(), run.context);
    const Eigen::VectorXd error = angles(surface.normals(), exact.u, run.context);
    run.report.error_name = "angle to the exact normal, radians";
    run.report.error = error_norms(error);
  }
  const FlatMesh mesh = scene.polygons ? scene.polygons->view() : surface.flat();
  write_outputs(scene,
                {mesh, {vector_field("normal", {"nx", "ny", "nz"}, FieldOn::face, mesh.normals)}},
                run);
}

}  // namespace dsc::cli
