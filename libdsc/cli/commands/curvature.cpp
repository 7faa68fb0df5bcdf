#include "libdsc/normals/curvature.h"

#include "libdsc/algorithms/mean_curvature.h"
#include "libdsc/calculus/vertex_average.h"
#include "libdsc/cli/commands/commands.h"
#include "libdsc/cli/known_curvatures.h"
#include "libdsc/cli/measured_shape.h"
#include "libdsc/cli/smooth_surface.h"

#include <Eigen/Geometry>

#include <cmath>

namespace dsc::cli {
namespace {

/// Mean, Gaussian, kappa_1, kappa_2, a row each.
using Curvatures = Eigen::Matrix<double, 4, Eigen::Dynamic, Eigen::RowMajor>;
using Known = std::vector<std::optional<ImplicitCurvature>>;

/// The errors of one estimate where the truth is known: error(i, truth) for each such i.
ErrorNorms errors_where_known(const Known& known, auto&& error) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i]) errors.push_back(error(static_cast<Index>(i), *known[i]));
  }
  ErrorNorms norms = error_norms(
      Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(errors.data(), std::ssize(errors))));
  norms.left_out = std::ssize(known) - std::ssize(errors);
  return norms;
}

void measure_mean(const Known& known, const Eigen::VectorXd& mean, Run& run) {
  run.report.error_name = "against the exact mean curvature";
  run.report.error = errors_where_known(
      known, [&](Index i, const ImplicitCurvature& truth) { return mean[i] - truth.mean; });
  warn_of_left_out(run);
}

/// Of faces or of vertices.
void measure_all(const Known& known, const Curvatures& values, Run& run) {
  measure_mean(known, values.row(0), run);
  const auto add = [&](const char* name, Index row, double ImplicitCurvature::*member) {
    run.report.further_errors.emplace_back(
        name, errors_where_known(known, [&](Index i, const ImplicitCurvature& truth) {
          return values(row, i) - truth.*member;
        }));
  };
  add("gaussian_curvature", 1, &ImplicitCurvature::gaussian);
  add("kappa_1", 2, &ImplicitCurvature::kappa_1);
  add("kappa_2", 3, &ImplicitCurvature::kappa_2);
}

/// The angle between the estimated and the exact principal direction, where there is one: where the
/// principal curvatures differ by a tenth of their size.
/// `known` loses the others.
void measure_directions(Known& known, const Eigen::Matrix3Xd& directions, Run& run) {
  bool any = false;
  for (auto& at : known) {
    const bool round =
        at && !(at->kappa_2 - at->kappa_1 > 0.1 * (std::abs(at->kappa_1) + std::abs(at->kappa_2)));
    if (round) at.reset();
    any = any || at;
  }
  if (!any) return;
  run.report.further_errors.emplace_back(
      "direction_1, radians",
      errors_where_known(known, [&](Index i, const ImplicitCurvature& truth) {
        const Vec3 d = directions.col(i);
        return std::atan2(d.cross(truth.direction_1).norm(), std::abs(d.dot(truth.direction_1)));
      }));
}

void measure(const Scene& scene, bool on_vertices, const Curvatures& values,
             const CurvatureField& field, Run& run) {
  const Stopwatch watch(run.report.timings.check);
  const ImplicitShape* shape = measured_shape(scene, run);
  if (shape == nullptr) return;
  const Eigen::Matrix3Xd points =
      on_vertices ? project_vertices(scene, run) : project_face_centres(scene, run);
  Known known = known_curvatures(*shape, {points.data(), points.cols()}, run.context);
  measure_all(known, values, run);
  if (!on_vertices) measure_directions(known, field.direction_1, run);
}

Field scalar_row(const char* name, FieldOn on, const Curvatures& rows, Index row) {
  return scalar_field(name, on,
                      std::span(rows.row(row).data(), static_cast<std::size_t>(rows.cols())));
}

void curvature_by_balls(Scene& scene, Run& run) {
  const auto& volume = std::get<BinaryVolume>(scene.input.voxels);
  CurvatureOptions options;
  options.radius = ball_radius(run.options, scene.input.shape != nullptr, volume.grid().spacing);
  options.form = run.options.form;
  options.beyond = beyond_of(scene.input);
  CurvatureField field;
  {
    const Stopwatch watch(run.report.timings.solve);
    field = integral_invariant_curvatures(volume, scene.surface.surfels(), options, run.context);
  }
  run.report.normals = NormalsReport{"ii", field.radius, field.fallbacks, field.cut_faces, {}};
  if (field.fallbacks > 0) {
    run.warn(std::to_string(field.fallbacks) + " of " + std::to_string(scene.surface.face_count()) +
             " faces have no normal of their ball; their curvatures are those across the face");
  }

  const bool on_vertices = run.options.on_vertices;
  run.context.need("curvature", 3 * 4 * 8 * field.mean.size());
  Eigen::MatrixXd per_face(4, field.mean.size());
  per_face << field.mean.transpose(), field.gaussian.transpose(), field.kappa_1.transpose(),
      field.kappa_2.transpose();
  Curvatures values = per_face;
  if (on_vertices) {
    scene.surface.set_normals(field.normals);
    values = average_to_vertices(scene.surface.flat(), per_face, {}, run.context);
  }
  run.report.result_name = "mean_curvature";
  run.report.result = statistics_of(values.row(0));

  measure(scene, on_vertices, values, field, run);

  const FieldOn on = on_vertices ? FieldOn::vertex : FieldOn::face;
  Result result{
      scene.surface.flat(false),
      {scalar_row("mean_curvature", on, values, 0), scalar_row("gaussian_curvature", on, values, 1),
       scalar_row("kappa_1", on, values, 2), scalar_row("kappa_2", on, values, 3)}};
  if (!on_vertices) {  // the mean of directions without a sign has no meaning
    const auto add = [&](const char* name, std::vector<std::string> parts,
                         const Eigen::Matrix3Xd& d) {
      result.fields.push_back(vector_field(name, std::move(parts), on, {d.data(), d.cols()}));
    };
    add("direction_1", {"k1x", "k1y", "k1z"}, field.direction_1);
    add("direction_2", {"k2x", "k2y", "k2z"}, field.direction_2);
  }
  write_outputs(scene, result, run);
}

void curvature_by_laplacian(Scene& scene, Run& run) {
  if (!scene.polygons) estimate_normals(scene, run);
  const SmoothSurface smooth = smooth_surface(scene, run);
  LaplaceBeltramiOptions options;
  if (run.options.curvature_lambda > 0) {
    options.calculus.lambda = run.options.curvature_lambda;
  } else {
    options.calculus.stabilization = Stabilization::mercat;
  }
  options.time = run.options.time.value_or(0.);
  MeanCurvature curvature;
  {
    const Stopwatch watch(run.report.timings.solve);
    curvature = mean_curvature(smooth.mesh, smooth.points(), options, run.context);
  }
  note_calculus(smooth.mesh.has_normals(), options.calculus, curvature.clamped_faces, run);
  if (curvature.undefined_vertices > 0) {
    run.warn("the normals cancel at " + std::to_string(curvature.undefined_vertices) +
             " vertices: their curvature is 0");
  }
  run.report.result_name = "mean_curvature";
  run.report.result = statistics_of(curvature.mean);
  {
    const Stopwatch watch(run.report.timings.check);
    if (const ImplicitShape* shape = measured_shape(scene, run)) {
      measure_mean(known_curvatures(*shape, smooth.points(), run.context), curvature.mean, run);
    }
  }
  write_outputs(scene,
                {scene.mesh(), {scalar_field("mean_curvature", FieldOn::vertex, curvature.mean)}},
                run);
}

}  // namespace

void run_curvature(Run& run) {
  Scene scene = open_scene(run);
  if (curvature_estimator(run.options) == CurvatureEstimator::integral_invariant) {
    curvature_by_balls(scene, run);
  } else {
    curvature_by_laplacian(scene, run);
  }
}

}  // namespace dsc::cli
