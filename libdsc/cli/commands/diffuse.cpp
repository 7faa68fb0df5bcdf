#include "libdsc/algorithms/diffusion.h"
#include "libdsc/cli/commands/commands.h"
#include "libdsc/cli/stages.h"

namespace dsc::cli {

void run_diffuse(Run& run) {
  const Scene scene = prepare_scene(run);
  const FlatMesh mesh = flat_mesh(scene, run);
  const std::vector<VertexId> sources = find_sources(scene, run);

  Timings& timings = run.report.timings;
  DiffusionOptions options;
  options.calculus = calculus_options(run);
  options.factory = [&](SparseMatrix A, const SolverOptions& solver, const Context& context) {
    const Stopwatch watch(timings.factorize);
    return make_spd_solver(std::move(A), solver, context);
  };
  std::optional<HeatDiffusion> diffusion;
  {
    const Stopwatch watch(timings.assemble);
    diffusion.emplace(mesh, *run.options.time, options, run.context);
  }
  timings.assemble -= timings.factorize;
  note_calculus(diffusion->clamped_faces(), run);

  // A unit of heat at a vertex is the density 1 / (its mass) there.
  Eigen::VectorXd heat = Eigen::VectorXd::Zero(mesh.vertices());
  for (const VertexId v : sources) heat[v] = 1. / diffusion->mass()[v];
  {
    const Stopwatch watch(timings.solve);
    heat = diffusion->step(heat).x;
  }
  run.report.result_name = "heat";
  {
    const Stopwatch watch(timings.check);
    run.report.result = statistics_of(heat);
  }
  write_outputs(scene, {mesh, {scalar_field("heat", FieldOn::vertex, heat)}}, run);
}

}  // namespace dsc::cli
