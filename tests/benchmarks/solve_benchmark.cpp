// Diffusion, Poisson's equation, the spectrum: everything after the normals, assembly included.
//
// Floor of a direct solver: 829/84 m³ multiply-adds for the factor of a 9-point m × m grid in
// nested dissection order (George 1973), m² vertices. Floor of an iterative one: each iteration
// reads the matrix, 9 entries of 12 bytes a vertex, and reads and writes a vector.
#include "libdsc/algorithms/diffusion.h"
#include "libdsc/algorithms/poisson.h"
#include "libdsc/calculus/assembly.h"
#include "libdsc/solve/spectrum.h"
#include "tests/benchmarks/measure.h"
#include "tests/benchmarks/scene.h"

#include <cmath>

namespace dsc::benchmarks {
namespace {

double factor_operations(double vertices) { return 829. / 84 * std::pow(vertices, 1.5); }

/// A system that is solved once.
constexpr SolverOptions kOnce{SolverMethod::automatic, 1e-9, kDirectLimitOnce};

void note_solver_floor(benchmark::State& state, double vertices, const Solution& solution) {
  if (resolve(kOnce, static_cast<Index>(vertices)) == SolverMethod::ldlt) {
    note_floor(state, factor_operations(vertices), kFma);
  } else {
    note_floor(state, 124. * vertices * static_cast<double>(solution.iterations), kMemory);
  }
  state.counters["iterations"] = static_cast<double>(solution.iterations);
}

/// x at the vertices, projected to the sphere: a harmonic of it, L x = -2 M0 x.
Eigen::VectorXd harmonic(const Scene& s) {
  return s.surface.positions().matrix().colwise().normalized().row(0).transpose();
}

/// One step of t = 0.04 in the sphere's unit. Error: against x / (1 + 2 t).
void diffusion(benchmark::State& state) {
  const Scene& s = scene(static_cast<int>(state.range(0)));
  const double t = 0.04;
  const Eigen::VectorXd x = harmonic(s);
  DiffusionOptions options;
  options.solver = kOnce;
  std::optional<Solution> u;
  measure(
      state, s.faces(), [&] { return diffuse(s.surface.flat(), x, t, options); }, u);
  note_errors(state, u->x - x / (1 + 2 * t));
  note_solver_floor(state, s.vertices(), *u);
}

/// L φ = -2 M0 x. Error: against x.
void poisson(benchmark::State& state) {
  const Scene& s = scene(static_cast<int>(state.range(0)));
  const Eigen::VectorXd x = harmonic(s);
  const Eigen::VectorXd mass = assemble_laplacian(s.surface.flat()).mass;
  Eigen::VectorXd b = -2. * mass.cwiseProduct(x);
  b -= b.sum() / mass.sum() * mass;
  PoissonOptions options;
  options.solver = kOnce;
  std::optional<Solution> phi;
  measure(
      state, s.faces(), [&] { return solve_poisson(s.surface.flat(), b, {}, {}, options); }, phi);
  note_errors(state, phi->x - x);
  note_solver_floor(state, s.vertices(), *phi);
}

/// Ten eigenvalues. Error: against 0, 2 × 3, 6 × 5, 12. One factor to solve with, one to count.
void spectrum(benchmark::State& state) {
  const Scene& s = scene(static_cast<int>(state.range(0)));
  std::optional<Spectrum> result;
  measure(
      state, s.faces(),
      [&] {
        const LaplaceSystem system = assemble_laplacian(s.surface.flat());
        return lowest_spectrum(-system.L, system.mass);
      },
      result);
  Eigen::VectorXd truth(10);
  truth << 0, 2, 2, 2, 6, 6, 6, 6, 6, 12;
  note_errors(state, result->values - truth);
  note_floor(state, 2. * factor_operations(s.vertices()), kFma);
}

const bool registered = [] {
  at_sizes("diffusion", diffusion, 515);
  at_sizes("poisson", poisson, 515);
  at_sizes("spectrum", spectrum, 193);
  return true;
}();

}  // namespace
}  // namespace dsc::benchmarks
