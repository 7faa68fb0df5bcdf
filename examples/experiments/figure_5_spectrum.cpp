// Figure 5: the spectrum of -M0^-1 L on the unit sphere, whose eigenvalues are l (l + 1), each 2l +
// 1 times.
#include "libdsc/calculus/assembly.h"
#include "libdsc/solve/spectrum.h"
#include "libdsc/voxels/shapes.h"
#include "study.h"

namespace {

std::string shells(const Eigen::VectorXd& values) {
  // Mean and spread of each shell of 2l + 1 values.
  std::string text;
  for (dsc::Index l = 1, k = 1; k + 2 * l + 1 <= values.size(); k += 2 * l + 1, ++l) {
    const auto shell = values.segment(k, 2 * l + 1);
    text += study::text(shell.mean(), l == 1 ? "%.4g" : ", %.4g") +
            study::text(0.5 * (shell.maxCoeff() - shell.minCoeff()), " ± %.2g");
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  const study::Arguments arguments(argc, argv);
  std::puts(
      "## Figure 5: spectrum of the sphere\n\n"
      "Mean and half spread of the eigenvalues of each multiplicity, which are 2, 6, 12 on the "
      "sphere.\n");
  study::Table table(arguments, "figure_5",
                     {"h", "vertices", "naive", "projected", "largest error of the 16 lowest"});
  std::vector<double> steps{0.1, 0.05, 0.03};
  if (arguments.full) steps.push_back(0.02);
  for (const double h : steps) {
    const auto [volume, surface] = study::digitized(dsc::Sphere(1.), h);
    const auto spectrum = [&, &surface = surface](bool projected) {
      const dsc::LaplaceSystem system = dsc::assemble_laplacian(surface.flat(projected));
      return dsc::lowest_spectrum(-system.L, system.mass, {.count = 16});
    };
    const dsc::Spectrum naive = spectrum(false);
    const dsc::Spectrum projected = spectrum(true);
    Eigen::VectorXd exact(16);
    exact << 0, 2, 2, 2, 6, 6, 6, 6, 6, 12, 12, 12, 12, 12, 12, 12;
    table.row({study::text(h), std::to_string(surface.vertex_count()), shells(naive.values),
               shells(projected.values),
               study::text((projected.values - exact).cwiseAbs().maxCoeff())});
    if (h == 0.05) {
      dsc::Result result{surface.flat(), {}};
      for (const auto& [name, s] : {std::pair{"naive", &naive}, {"projected", &projected}}) {
        for (dsc::Index k = 0; k < 10; ++k) {
          const std::span<const double> mode(s->vectors.col(k).data(),
                                             static_cast<std::size_t>(s->vectors.rows()));
          result.fields.push_back(
              dsc::scalar_field(name + ("_" + std::to_string(k)), dsc::FieldOn::vertex, mode));
        }
      }
      dsc::write_result((arguments.out / "figure_5.vtp").string(), result);
    }
  }
  std::puts(
      "\nPaper: shows the first eigenvectors, without numbers. Another implementation at h = 0.1: "
      "naive 1.446 ×3, 4.15 ×2, 4.46 ×3; projected 2.018 ×3, 6.008 ×3, 6.080 ×2. The count of "
      "eigenvalues is verified by inertia, so no copy is missing.");
}
