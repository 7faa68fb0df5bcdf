#include "libdsc/algorithms/diffusion.h"
#include "libdsc/cli/commands/commands.h"
#include "libdsc/cli/stages.h"

namespace dsc::cli {
namespace {

Eigen::VectorXd heat_of(const FlatMesh& mesh, const std::vector<VertexId>& sources,
                        Index& clamped_faces, Run& run) {
  Timings& timings = run.report.timings;
  DiffusionOptions options;
  options.calculus = calculus_options(run);
  options.factory = timed_solvers(run);
  std::optional<HeatDiffusion> diffusion;
  {
    const Stopwatch watch(timings.assemble);
    diffusion.emplace(mesh, *run.options.time, options, run.context);
  }
  timings.assemble -= timings.factorize;
  clamped_faces = diffusion->clamped_faces();

  // A unit of heat at a vertex is the density 1 / (its mass) there.
  Eigen::VectorXd heat = Eigen::VectorXd::Zero(mesh.vertices());
  for (const VertexId v : sources) heat[v] = 1. / diffusion->mass()[v];
  {
    const Stopwatch watch(timings.solve);
    heat = diffusion->step(heat, run.context).x;
  }
  return heat;
}

}  // namespace

void run_diffuse(Run& run) {
  const Scene scene = prepare_scene(run);
  const FlatMesh mesh = flat_mesh(scene, run);
  const std::optional<FlatMesh> naive_mesh = mesh_to_compare(mesh, run);
  const std::vector<VertexId> sources = find_sources(scene, run);
  Index clamped_faces = 0;
  const Eigen::VectorXd heat = heat_of(mesh, sources, clamped_faces, run);
  note_calculus(clamped_faces, run);
  Eigen::VectorXd naive;
  if (naive_mesh) {
    naive = compared(run, [&] { return heat_of(*naive_mesh, sources, clamped_faces, run); });
  }
  run.report.result_name = "heat";
  {
    const Stopwatch watch(run.report.timings.check);
    run.report.result = statistics_of(heat);
  }
  Result fields{mesh, {scalar_field("heat", FieldOn::vertex, heat)}};
  if (naive_mesh) fields.fields.push_back(scalar_field("heat_naive", FieldOn::vertex, naive));
  write_outputs(scene, fields, run);
}

}  // namespace dsc::cli
