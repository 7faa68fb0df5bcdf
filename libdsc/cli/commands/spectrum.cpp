#include "libdsc/solve/spectrum.h"

#include "libdsc/calculus/assembly.h"
#include "libdsc/cli/commands/commands.h"
#include "libdsc/cli/stages.h"
#include "libdsc/solve/checkerboard.h"
#include "libdsc/solve/matrix_memory.h"
#include "libdsc/voxels/shapes.h"

namespace dsc::cli {
namespace {

/// The lowest `count` eigenvalues of a sphere of radius r: l (l + 1) / r^2, each 2l + 1 times.
Eigen::VectorXd sphere_spectrum(Index count, double r) {
  Eigen::VectorXd values(count);
  Index k = 0;
  for (Index l = 0; k < count; ++l) {
    for (Index m = 0; m < 2 * l + 1 && k < count; ++m) {
      values[k++] = static_cast<double>(l * (l + 1)) / (r * r);
    }
  }
  return values;
}

}  // namespace

void run_spectrum(Run& run) {
  const Scene scene = prepare_scene(run);
  const FlatMesh mesh = flat_mesh(scene, run);

  const LaplaceSystem system = [&] {
    const Stopwatch watch(run.report.timings.assemble);
    return assemble_laplacian(mesh, calculus_options(run), run.context);
  }();
  note_calculus(system.clamped_faces, run);

  const bool mercat = run.options.stabilisation == Stabilization::mercat;
  Spectrum spectrum;
  {
    const Stopwatch watch(run.report.timings.solve);
    run.context.need("spectrum", matrix_bytes(system.L));
    const SpectrumOptions options{.count = run.options.count};
    if (mercat) {
      const SparseMatrix S = checkerboard_form(mesh, calculus_options(run), run.context);
      spectrum = lowest_smooth_spectrum(-system.L, system.mass, S, options, run.context);
    } else {
      spectrum = lowest_spectrum(-system.L, system.mass, options, run.context);
    }
  }
  run.report.spectrum = SpectrumReport{
      {spectrum.values.begin(), spectrum.values.end()}, spectrum.residual, spectrum.rounds, {}};
  if (mercat) run.report.spectrum->checkerboards = spectrum.checkerboards;
  run.report.result_name = "eigenvalue";
  run.report.result = statistics_of(spectrum.values);
  if (const auto* sphere = dynamic_cast<const Sphere*>(scene.input.shape.get())) {
    run.report.error_name = "against l (l + 1) / r^2";
    run.report.error =
        error_norms(spectrum.values, sphere_spectrum(run.options.count, sphere->radius()));
  }

  Result result{mesh, {}};
  for (Index k = 0; k < run.options.count; ++k) {
    const double* values = spectrum.vectors.col(k).data();
    result.fields.push_back(
        scalar_field("eigenvector_" + std::to_string(k), FieldOn::vertex,
                     std::span(values, static_cast<std::size_t>(mesh.vertices()))));
  }
  write_outputs(scene, result, run);
}

}  // namespace dsc::cli
