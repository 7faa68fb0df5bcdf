#include "libdsc/algorithms/laplace_beltrami.h"
#include "libdsc/cli/commands/commands.h"
#include "libdsc/cli/known_curvatures.h"
#include "libdsc/cli/measured_shape.h"
#include "libdsc/cli/smooth_surface.h"

namespace dsc::cli {
namespace {

struct LaplacianAnswer {
  Eigen::VectorXd values, laplacian;
};

/// Of f, sampled at the points of `surface`. Notes the calculus in the report.
LaplacianAnswer laplacian_of(const Expression& f, const SmoothSurface& surface, const Scene& scene,
                             Run& run) {
  Timings& timings = run.report.timings;
  LaplacianAnswer answer;
  {
    const Stopwatch watch(timings.assemble);
    answer.values = sample(f, surface.points(), scene, run);
  }
  LaplaceBeltramiOptions options;
  options.calculus = calculus_options(run);
  options.time = run.options.time.value_or(0.);
  std::optional<LaplaceBeltrami> op;
  {
    const Stopwatch watch(timings.assemble);
    op.emplace(surface.mesh, options, run.context);
  }
  timings.factorize = op->seconds_factorize();
  timings.assemble -= timings.factorize;
  note_calculus(surface.mesh.has_normals(), options.calculus, op->system().clamped_faces, run);
  {
    const Stopwatch watch(timings.solve);
    answer.laplacian = (*op)(answer.values, run.context).x;
  }
  return answer;
}

/// What the naive calculus works on: the shape's points all the same, of voxels the vertices.
SmoothSurface naive_surface(const FlatMesh& naive, const Scene& scene,
                            const SmoothSurface& smooth) {
  SmoothSurface surface;
  surface.mesh = naive;
  surface.positions = scene.input.shape ? smooth.positions : scene.positions().matrix();
  return surface;
}

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
  const std::optional<FlatMesh> naive_mesh = mesh_to_compare(flat_mesh(scene, run), run);
  const SmoothSurface smooth = smooth_surface(scene, run);
  LaplacianAnswer naive;
  if (naive_mesh) {  // first, so that the report is about the other
    naive = compared(run, [&] {
      return laplacian_of(f, naive_surface(*naive_mesh, scene, smooth), scene, run);
    });
  }
  const LaplacianAnswer answer = laplacian_of(f, smooth, scene, run);
  {
    const Stopwatch watch(run.report.timings.check);
    run.report.result_name = "laplacian";
    run.report.result = statistics_of(answer.laplacian);
    if (const ImplicitShape* shape = measured_shape(scene, run)) {
      measure_error(f, *shape, smooth.points(), answer.laplacian, run);
    }
  }
  Result fields{scene.mesh(),
                {scalar_field("function", FieldOn::vertex, answer.values),
                 scalar_field("laplacian", FieldOn::vertex, answer.laplacian)}};
  if (naive_mesh) {
    fields.fields.push_back(scalar_field("laplacian_naive", FieldOn::vertex, naive.laplacian));
  }
  write_outputs(scene, fields, run);
}

}  // namespace dsc::cli
