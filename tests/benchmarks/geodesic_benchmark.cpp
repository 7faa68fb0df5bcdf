// Geodesic distance, all after the normals included; the sphere has its own normals. Errors against
// great circles through the vertices' radial projections.
//
// Floor: the matrix is assembled (160 bytes a face streamed), and each iteration of Poisson's
// equation reads it and reads and writes a vector (124 bytes a vertex); a direct one reads its two
// factors twice, 31/4 V log2(V)/2 entries of 12 bytes each (George 1973, V vertices).
#include "libdsc/algorithms/geodesic.h"
#include "tests/benchmarks/measure.h"
#include "tests/benchmarks/scene.h"

#include <Eigen/Geometry>
#include <cmath>

namespace dsc::benchmarks {
namespace {

constexpr VertexId kSource = 0;

void note_distance(benchmark::State& state, const Scene& s, VertexId source,
                   const GeodesicResult& result) {
  state.counters["iterations"] = static_cast<double>(result.report.poisson_iterations);
  if (s.n == kSpot) return;
  const Vec3 from = s.surface.position(source).normalized();
  Eigen::VectorXd errors(result.distance.size());
  for (Index v = 0; v < errors.size(); ++v) {
    const Vec3 to = s.surface.position(static_cast<VertexId>(v)).normalized();
    errors[v] = result.distance[v] - std::atan2(from.cross(to).norm(), from.dot(to));
  }
  note_errors(state, errors);
}

double iteration_bytes(const Scene& s, const GeodesicResult& result) {
  return 124. * s.vertices() * static_cast<double>(result.report.poisson_iterations);
}

double factor_entries(double vertices) { return 31. / 8 * vertices * std::log2(vertices); }

/// One distance field, from nothing.
void first(benchmark::State& state) {
  const Scene& s = scene(static_cast<int>(state.range(0)));
  std::optional<GeodesicResult> result;
  measure(
      state, s.faces(),
      [&] {
        return geodesic_distance(s.surface.flat(), {&kSource, 1});
      },
      result);
  note_distance(state, s, kSource, *result);
  note_floor(state, 160. * s.faces() + iteration_bytes(s, *result), kMemory);
}

/// A field from another source, on a solver that has served one.
void further(benchmark::State& state) {
  const Scene& s = scene(static_cast<int>(state.range(0)));
  GeodesicOptions options;
  options.method = HeatMethod::bands;
  const GeodesicSolver solver(s.surface.flat(), options);
  const VertexId source = static_cast<VertexId>(s.surface.vertex_count() / 2);
  std::optional<GeodesicResult> result;
  measure(
      state, s.faces(),
      [&] {
        return solver.distance({&source, 1});
      },
      result);
  note_distance(state, s, source, *result);
  note_floor(state, iteration_bytes(s, *result), kMemory);
}

/// Every factor that any source needs.
void prepare(benchmark::State& state) {
  const Scene& s = scene(static_cast<int>(state.range(0)));
  GeodesicOptions options;
  options.method = HeatMethod::direct;
  options.poisson.method = SolverMethod::ldlt;
  std::optional<GeodesicSolver> solver;
  measure(
      state, s.faces(), [&] { return GeodesicSolver(s.surface.flat(), options); }, solver);
  note_floor(state, 2. * 829. / 84 * std::pow(s.vertices(), 1.5), kFma);
}

/// A field each from eight sources, after that; the time is of one.
void prepared(benchmark::State& state) {
  const Scene& s = scene(static_cast<int>(state.range(0)));
  GeodesicOptions options;
  options.method = HeatMethod::direct;
  options.poisson.method = SolverMethod::ldlt;
  const GeodesicSolver solver(s.surface.flat(), options);
  std::optional<GeodesicResult> result;
  Index k = 0;
  VertexId source = 0;
  measure(
      state, s.faces(),
      [&] {
        source = static_cast<VertexId>(k++ % 8 * s.surface.vertex_count() / 8);
        return solver.distance({&source, 1});
      },
      result);
  note_distance(state, s, source, *result);
  note_floor(state, 2. * 2. * 12. * factor_entries(s.vertices()), kMemory);
}

const bool registered = [] {
  at_sizes_and_spot("geodesic_first", first, 515);
  at_sizes_and_spot("geodesic_further", further, 303);
  at_sizes_and_spot("geodesic_prepare", prepare, 193);
  at_sizes_and_spot("geodesic_prepared", prepared, 193);
  return true;
}();

}  // namespace
}  // namespace dsc::benchmarks
