// Assembly of L and M0: the pattern, and its numbers.
#include "libdsc/calculus/assembly.h"
#include "libdsc/calculus/laplacian_pattern.h"
#include "tests/benchmarks/measure.h"
#include "tests/benchmarks/scene.h"

namespace dsc::benchmarks {
namespace {

/// Floor, bytes a face (about one vertex and 9 entries): corners 16 in; incident corners 16, slots
/// 16, column starts 8 and rows 36 out.
void pattern(benchmark::State& state) {
  const Scene& s = scene(static_cast<int>(state.range(0)));
  std::optional<LaplacianPattern> result;
  const FlatMesh mesh = s.surface.flat();
  measure(
      state, s.faces(), [&] { return LaplacianPattern(mesh); }, result);
  note_floor(state, 92. * s.faces(), kMemory);
}

/// Floor, bytes a face: normal 24, surfel 16, incident corners 16, slots 16 and column starts 8 in;
/// values 72 and mass 8 out.
void fill(benchmark::State& state) {
  const Scene& s = scene(static_cast<int>(state.range(0)));
  const FlatMesh mesh = s.surface.flat();
  const LaplacianPattern pattern(mesh);
  LaplaceSystem system = pattern.assemble(mesh);
  std::optional<bool> done;
  measure(
      state, s.faces(),
      [&] {
        pattern.refill(system, mesh);
        return true;
      },
      done);
  note_floor(state, 160. * s.faces(), kMemory);
}

const bool registered = [] {
  at_sizes_and_spot("pattern", pattern, 515);
  at_sizes_and_spot("fill", fill, 515);
  return true;
}();

}  // namespace
}  // namespace dsc::benchmarks
