#include "libdsc/calculus/field_operators.h"
#include "libdsc/cli/commands/commands.h"
#include "libdsc/cli/known_answers.h"
#include "libdsc/cli/stages.h"
#include "libdsc/voxels/closest_point.h"

namespace dsc::cli {
namespace {

/// f at every vertex: where the vertices digitise a shape, at the shape's points closest to them.
Eigen::VectorXd sample(const Expression& f, const Scene& scene, Run& run) {
  if (!scene.input.shape) return sample_at_vertices(f, scene, run);
  const Vec3View positions = scene.surface.positions();
  const ProjectedPoints projected = project_points(*scene.input.shape, positions, run.context);
  if (projected.failures > 0) {
    run.warn("the closest point of the shape was not found for " +
             std::to_string(projected.failures) + " of " + std::to_string(positions.size) +
             " vertices");
  }
  return f({projected.points.data(), positions.size}, run.context);
}

Eigen::Matrix3Xd face_centres(const DigitalSurface& surface) {
  Eigen::Matrix3Xd centres(3, surface.face_count());
  Index f = 0;
  for (const Surfel& surfel : surface.surfels()) centres.col(f++) = surfel.centre(surface.grid());
  return centres;
}

void measure_error(const Expression& f, const Scene& scene, const Eigen::Matrix3Xd& gradients,
                   Run& run) {
  const Eigen::Matrix3Xd centres = face_centres(scene.surface);
  const KnownGradients known =
      known_gradients(*scene.input.shape, f, {centres.data(), centres.cols()}, run.context);
  if (known.failures > 0) {
    run.warn("the exact gradient is uncertain at " + std::to_string(known.failures) + " of " +
             std::to_string(centres.cols()) + " faces: no closest point of the shape was found");
  }
  const Eigen::VectorXd error = (gradients - known.gradients).colwise().norm();
  run.report.error_name = "length of the difference to the exact gradient";
  run.report.error = error_norms(error);
}

}  // namespace

void run_gradient(Run& run) {
  const Expression f(run.options.function);  // a typing error shows at once
  const Scene scene = prepare_scene(run);
  const FlatMesh mesh = flat_mesh(scene, run);
  const Eigen::VectorXd phi = sample(f, scene, run);
  Eigen::Matrix3Xd gradients;
  {
    const Stopwatch watch(run.report.timings.solve);
    gradients = face_gradients(mesh, phi, calculus_options(run), run.context);
  }
  note_calculus(count_clamped_faces(mesh, calculus_options(run)), run);
  const Eigen::VectorXd lengths = gradients.colwise().norm();
  run.report.result_name = "|gradient|";
  run.report.result = statistics_of(lengths);
  if (scene.input.shape) measure_error(f, scene, gradients, run);
  write_outputs(scene,
                {mesh,
                 {vector_field("gradient", {"gx", "gy", "gz"}, FieldOn::face,
                               {gradients.data(), gradients.cols()})}},
                run);
}

}  // namespace dsc::cli
