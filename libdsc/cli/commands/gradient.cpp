#include "libdsc/base/error.h"
#include "libdsc/calculus/field_operators.h"
#include "libdsc/cli/commands/commands.h"
#include "libdsc/cli/known_answers.h"
#include "libdsc/cli/measured_shape.h"
#include "libdsc/voxels/closest_point.h"

namespace dsc::cli {
namespace {

/// Of vectors of any size, whose squares may pass the range of doubles.
Eigen::VectorXd lengths_of(const Eigen::Matrix3Xd& vectors) {
  Eigen::VectorXd lengths(vectors.cols());
  for (Index i = 0; i < lengths.size(); ++i) lengths[i] = vectors.col(i).stableNorm();
  return lengths;
}

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

void measure_error(const Expression& f, const Scene& scene, const Eigen::Matrix3Xd& gradients,
                   Run& run) {
  const ImplicitShape* shape = measured_shape(scene, run);
  if (shape == nullptr) return;
  const Eigen::Matrix3Xd centres = face_centres(scene.surface);
  const KnownVectors known =
      known_gradients(*shape, f, {centres.data(), centres.cols()}, run.context);
  run.report.error_name = "length of the difference to the exact gradient";
  run.report.error = error_norms(lengths_of(gradients - known.vectors), known.known);
  warn_of_left_out(run);
}

}  // namespace

void run_gradient(Run& run) {
  const Expression f(run.options.function);  // a typing error shows at once
  const Scene scene = prepare_scene(run);
  const FlatMesh mesh = flat_mesh(scene, run);
  const std::optional<FlatMesh> naive_mesh = mesh_to_compare(mesh, run);
  Eigen::VectorXd phi;
  Eigen::Matrix3Xd gradients, naive;
  {
    const Stopwatch watch(run.report.timings.solve);
    phi = sample(f, scene, run);
    gradients = face_gradients(mesh, phi, calculus_options(run), run.context);
    note_calculus(count_clamped_faces(mesh, calculus_options(run), run.context), run);
  }
  if (naive_mesh) {
    naive = compared(
        run, [&] { return face_gradients(*naive_mesh, phi, calculus_options(run), run.context); });
  }
  {
    const Stopwatch watch(run.report.timings.check);
    const Eigen::VectorXd lengths = lengths_of(gradients);
    if (!lengths.allFinite() || !naive.allFinite()) {
      throw InputError("--function '" + run.options.function +
                       "': its gradient passes the range of doubles; scale it down");
    }
    run.report.result_name = "|gradient|";
    run.report.result = statistics_of(lengths);
    measure_error(f, scene, gradients, run);
  }
  Result fields{mesh,
                {vector_field("gradient", {"gx", "gy", "gz"}, FieldOn::face,
                              {gradients.data(), gradients.cols()})}};
  if (naive_mesh) {
    fields.fields.push_back(vector_field("gradient_naive", {"gx_naive", "gy_naive", "gz_naive"},
                                         FieldOn::face, {naive.data(), naive.cols()}));
  }
  write_outputs(scene, fields, run);
}

}  // namespace dsc::cli
