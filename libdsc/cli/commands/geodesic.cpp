#include "libdsc/algorithms/geodesic.h"
#include "libdsc/cli/commands/commands.h"
#include "libdsc/cli/known_answers.h"
#include "libdsc/cli/measured_shape.h"

namespace dsc::cli {
namespace {

GeodesicOptions geodesic_options(const Run& run) {
  GeodesicOptions options;
  options.calculus = calculus_options(run);
  options.time = run.options.time.value_or(0.);
  switch (run.options.boundary) {
    case BoundaryChoice::neumann:
      options.boundary = HeatBoundary::neumann;
      break;
    case BoundaryChoice::mixed:
      options.boundary = HeatBoundary::mixed;
      break;
  }
  switch (run.options.method) {
    case DistanceMethod::automatic:
      options.method = HeatMethod::automatic;
      break;
    case DistanceMethod::direct:
      options.method = HeatMethod::direct;
      break;
    case DistanceMethod::bands:
      options.method = HeatMethod::bands;
      break;
  }
  return options;
}

GeodesicResult solve(const FlatMesh& mesh, const std::vector<VertexId>& sources, Run& run) {
  const GeodesicOptions options = for_one_query(geodesic_options(run));
  Timings& timings = run.report.timings;
  std::optional<GeodesicSolver> solver;
  {
    const Stopwatch watch(timings.assemble);
    solver.emplace(mesh, options, run.context);
  }
  GeodesicResult result;
  {
    const Stopwatch watch(timings.solve);
    result = solver->distance(sources, run.context);
  }
  timings.factorize = result.report.seconds_factorize;
  timings.assemble -= timings.factorize;
  return result;
}

HeatReport heat_report(const GeodesicReport& report) {
  return {.time = report.time,
          .time_raised = report.time_raised,
          .method = report.method == HeatMethod::bands ? "bands" : "direct",
          .components_without_source = report.components_without_source,
          .flat_faces = report.flat_faces,
          .negative_faces = report.negative_faces,
          .raised_vertices = report.raised_values,
          .lowest_value = report.lowest_value,
          .heat_residual = report.heat_residual,
          .poisson_residual = report.poisson_residual,
          .poisson_iterations = report.poisson_iterations};
}

/// What the solver had to do that the user should know.
void warn_of(const GeodesicReport& report, Run& run) {
  if (report.time_raised) {
    run.warn("the time of the heat step was raised to " + std::to_string(report.time) +
             ": heat did not reach every vertex before");
  }
  if (report.components_without_source > 0) {
    run.warn(std::to_string(report.components_without_source) + " of " +
             std::to_string(report.components) +
             " components have no source: the distance is infinite there");
  }
}

/// `naive` is empty where it was not asked for.
void measure_error(const Scene& scene, const FlatMesh& mesh, const std::vector<VertexId>& sources,
                   const Eigen::VectorXd& distance, const Eigen::VectorXd& naive, Run& run) {
  if (!scene.input.shape) return;
  Eigen::Matrix3Xd points(3, static_cast<Index>(sources.size()));
  for (Index i = 0; i < points.cols(); ++i) {
    points.col(i) = mesh.positions[sources[static_cast<std::size_t>(i)]];
  }
  const std::optional<Eigen::VectorXd> known =
      known_distances(*scene.input.shape, mesh.positions, points, run.context);
  if (!known || measured_shape(scene, run) == nullptr) return;
  run.report.error_name = "against the exact distance";
  run.report.error = error_norms(distance, *known);
  if (naive.size() > 0) {
    run.report.further_errors.emplace_back("distance_naive", error_norms(naive, *known));
  }
}

}  // namespace

void run_geodesic(Run& run) {
  const Scene scene = prepare_scene(run);
  const FlatMesh mesh = flat_mesh(scene, run);
  const std::optional<FlatMesh> naive_mesh = mesh_to_compare(mesh, run);
  const std::vector<VertexId> sources = find_sources(scene, run);
  const GeodesicResult result = solve(mesh, sources, run);

  note_calculus(result.report.clamped_faces, run);
  run.report.heat = heat_report(result.report);
  warn_of(result.report, run);
  Eigen::VectorXd naive;
  if (naive_mesh) {
    naive = compared(run, [&] { return solve(*naive_mesh, sources, run).distance; });
  }
  {
    const Stopwatch watch(run.report.timings.check);
    run.report.result_name = "distance";
    run.report.result = statistics_of(result.distance);
    measure_error(scene, mesh, sources, result.distance, naive, run);
  }
  Result fields{mesh, {scalar_field("distance", FieldOn::vertex, result.distance)}};
  if (naive_mesh) fields.fields.push_back(scalar_field("distance_naive", FieldOn::vertex, naive));
  write_outputs(scene, fields, run);
}

}  // namespace dsc::cli
