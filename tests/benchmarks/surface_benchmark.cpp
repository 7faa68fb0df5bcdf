// Extraction into the halfedge mesh, side table included.
#include "libdsc/surface/extract.h"
#include "tests/benchmarks/measure.h"
#include "tests/benchmarks/scene.h"

namespace dsc::benchmarks {
namespace {

/// Floor: the bytes of the mesh and its table, written once. `kept` is their number: the time of
/// first-touching them is what the cold run is compared with.
void extract(benchmark::State& state) {
  const Scene& s = scene(static_cast<int>(state.range(0)));
  std::optional<DigitalSurface> surface;
  const Cost cost = measure(
      state, s.faces(), [&] { return extract_surface(s.volume); }, surface);
  state.counters["kept"] = cost.kept;
  note_floor(state, cost.kept, kMemory);
}

const bool registered = [] {
  at_sizes_and_spot("extract", extract, 515);
  return true;
}();

}  // namespace
}  // namespace dsc::benchmarks
