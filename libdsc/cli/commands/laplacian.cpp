#include "libdsc/algorithms/laplace_beltrami.h"
#include "libdsc/cli/commands/commands.h"
#include "libdsc/cli/known_curvatures.h"
#include "libdsc/cli/measured_shape.h"
#include "libdsc/cli/smooth_surface.h"

namespace dsc::cli {
namespace {

void measure_error(const Expression& f, const ImplicitShape& shape, Vec3View points,
                   const Eigen::VectorXd& laplacian, Run& run) {
  const auto known = known_laplacians(shape, f, points, run.context);
  Eigen::VectorXd errors = Eigen::VectorXd::Zero(laplacian.size());
  std::vector<char> is_known(known.size(), 0);
  for (std::size_t v = 0; v < known.size(); ++v) {
    if (!known[v]) continue;
    errors[static_cast<Index>(v)] = laplacian[static_cast<Index>(v)] - *known[v];
    is_known[v] = 1;
  }
  run.report.error_name = "against the exact Laplace-Beltrami operator";
  run.report.error = error_norms(errors, is_known);
  warn_of_left_out(run);
}

}  // namespace

void run_laplacian(Run& run) {
  const Expression f(run.options.function);  // a typing error shows at once
  const Scene scene = prepare_scene(run);
  const SmoothSurface smooth = smooth_surface(scene, run);
  Timings& timings = run.report.timings;
  Eigen::VectorXd values;
  {
    const Stopwatch watch(timings.assemble);
    values = sample(f, smooth.points(), scene, run);
  }
  LaplaceBeltramiOptions options;
  options.calculus = calculus_options(run);
  options.time = run.options.time.value_or(0.);
  std::optional<LaplaceBeltrami> op;
  {
    const Stopwatch watch(timings.assemble);
    op.emplace(smooth.mesh, options, run.context);
  }
  timings.factorize = op->seconds_factorize();
  timings.assemble -= timings.factorize;
  note_calculus(smooth.mesh.has_normals(), options.calculus, op->system().clamped_faces, run);
  Solution laplacian;
  {
    const Stopwatch watch(timings.solve);
    laplacian = (*op)(values);
  }
  {
    const Stopwatch watch(timings.check);
    run.report.result_name = "laplacian";
    run.report.result = statistics_of(laplacian.x);
    if (const ImplicitShape* shape = measured_shape(scene, run)) {
      measure_error(f, *shape, smooth.points(), laplacian.x, run);
    }
  }
  write_outputs(scene,
                {scene.mesh(),
                 {scalar_field("function", FieldOn::vertex, values),
                  scalar_field("laplacian", FieldOn::vertex, laplacian.x)}},
                run);
}

}  // namespace dsc::cli
