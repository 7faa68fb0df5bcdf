/// \file
/// The stages that commands share: read, extract, estimate normals, write. Each one notes its time
/// and its findings in the run's report.
#pragma once

#include "libdsc/calculus/options.h"
#include "libdsc/cli/input.h"
#include "libdsc/cli/mesh_input.h"
#include "libdsc/cli/run.h"
#include "libdsc/io/results.h"
#include "libdsc/solve/spd_solver.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/voxels/expression.h"

#include <optional>
#include <vector>

namespace dsc::cli {

/// What every command works on: voxels and their surface, or a mesh, and then those are empty.
struct Scene {
  Input input;
  DigitalSurface surface;
  std::optional<PolygonMesh> polygons = {};

  /// Positions and faces alone.
  FlatMesh mesh() const { return polygons ? polygons->view() : surface.flat(false); }
  Vec3View positions() const { return polygons ? polygons->view().positions : surface.positions(); }
};

/// Reads the input and extracts its surface. \throws InputError where it has no face, though voxels
/// are inside.
Scene open_scene(Run& run);

/// What balls find beyond the volume: emptiness, or more of the object where the border cuts it.
Beyond beyond_of(const Input& input);

/// Warns where the default radius, made for shapes of unit size, does not suit this shape.
void check_default_radius(const Input& input, double radius, Run& run);

/// Estimates normals as the options say and writes them to the surface; a mesh gets its own.
void estimate_normals(Scene& scene, Run& run);

/// Both, normals only for the projected calculus; those of a mesh are the file's.
Scene prepare_scene(Run& run);

/// f at the world positions of the vertices.
Eigen::VectorXd sample_at_vertices(const Expression& f, const Scene& scene, Run& run);

/// make_spd_solver(), its time counted as that of the factorization. `run` outlives it.
SpdSolverFactory timed_solvers(Run& run);

/// The mesh that the calculus reads: naive where the options ask for it.
FlatMesh flat_mesh(const DigitalSurface& surface, const Run& run);
FlatMesh flat_mesh(const Scene& scene, const Run& run);
CalculusOptions calculus_options(const Run& run);

/// The faces whose normal the calculus tilts back (embedding.h), where no operator tells.
Index count_clamped_faces(const FlatMesh& mesh, const CalculusOptions& options,
                          const Context& context);

/// The same mesh for the naive calculus, where the options ask for its result too (--compare).
/// \throws UsageError where `mesh` is naive already: a file without normals.
std::optional<FlatMesh> mesh_to_compare(FlatMesh mesh, const Run& run);

/// What `compute` returns, its time noted as that of a check whatever it notes itself.
template <class Compute>
auto compared(Run& run, const Compute& compute) {
  Timings& timings = run.report.timings;
  const Timings before = timings;
  double seconds = 0;
  auto result = [&] {
    const Stopwatch watch(seconds);
    return compute();
  }();
  timings = before;
  timings.check += seconds;
  return result;
}

/// Puts the calculus into the report.
void note_calculus(Index clamped_faces, Run& run);
void note_calculus(bool projected, const CalculusOptions& options, Index clamped_faces, Run& run);

/// The vertex ids of the options' sources: the vertex nearest to each point of the world, lowest id
/// first among equals, and the ids given. Sorted, each once. \throws UsageError for an id that the
/// surface does not have.
std::vector<VertexId> find_sources(const Scene& scene, Run& run);

/// Writes the result to every output, as it lies in the world, with the fields of a mesh file.
void write_outputs(const Scene& scene, const Result& result, Run& run);

}  // namespace dsc::cli
