// Each stage takes at most what it asks for and at least a third of it.
#include "tests/support/stage_memory.h"
#include "libdsc/algorithms/geodesic.h"
#include "libdsc/algorithms/poisson.h"
#include "libdsc/algorithms/regularise.h"
#include "libdsc/calculus/assembly.h"
#include "libdsc/io/mesh_reader.h"
#include "libdsc/io/read_binary.h"
#include "libdsc/io/read_labels.h"
#include "libdsc/io/results.h"
#include "libdsc/io/volume_writer.h"
#include "libdsc/normals/curvature.h"
#include "libdsc/normals/surface_normals.h"
#include "libdsc/solve/spectrum.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/surface/polygon_topology.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/shapes.h"
#include "tests/io/temporary_folder.h"

#include <gtest/gtest.h>

namespace dsc {
namespace {

DigitalSurface sphere(double h, BinaryVolume& voxels, const Context& context) {
  voxels = digitize(Sphere(1.), {h, h, h}, context);
  return extract_surface(voxels, {}, context);
}

void run_normals(const Context& context) {
  BinaryVolume voxels;
  DigitalSurface surface = sphere(0.007, voxels, context);
  integral_invariant_normals(surface, voxels, {.radius = 0.06}, context);
  context.need("between", 0);  // else both would count as one
  integral_invariant_normals(surface, voxels, {.radius = 0.02}, context);
  context.need("between", 0);
  trivial_normals(surface, context);
  (void)integral_invariant_curvatures(voxels, surface.surfels(), {.radius = 0.04}, context);
}

void run_distances(double h, HeatMethod method, const Context& context) {
  BinaryVolume voxels;
  DigitalSurface surface = sphere(h, voxels, context);
  trivial_normals(surface, context);
  const VertexId source = 0;
  GeodesicOptions options;
  options.method = method;
  (void)GeodesicSolver(surface.flat(), options, context).distance({&source, 1}, context);
}

void run_solvers(const Context& context) {
  BinaryVolume voxels;
  DigitalSurface surface = sphere(0.02, voxels, context);
  trivial_normals(surface, context);
  const LaplaceSystem system = assemble_laplacian(surface.flat(), {}, context);
  context.need("between", 0);
  const SparseMatrix A = -system.L;
  (void)lowest_spectrum(A, system.mass, {.count = 40}, context);
  (void)regularise_positions(surface.flat(), {}, context);
}

void run_voxels(const Context& context) {
  {
    BinaryVolume voxels;
    (void)sphere(0.005, voxels, context);
  }
  const TemporaryFolder folder;
  {
    const Grid grid{{400, 300, 300}, {1, 1, 1}, {0, 0, 0}};
    std::vector<std::uint16_t> values(36000000);
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = static_cast<std::uint16_t>(i % 400 / 50 * (i / 400 % 300 / 50) * (i / 6000000));
    }
    write_volume(folder / "v.npy", grid, values);
  }
  LabelVolume labels = read_labels(folder / "v.npy", context);
  (void)extract_surface(labels, {}, context);
  labels = LabelVolume();
  const BinaryVolume voxels = read_binary(folder / "v.npy", {}, context);
  ExtractOptions open;
  open.border = Border::open;
  (void)extract_surface(voxels, open, context);
}

void run_checkerboard(const Context& context) {
  BinaryVolume voxels(Grid{{50, 50, 50}, {1, 1, 1}, {0, 0, 0}});
  for (Index i = 0; i < 125000; ++i) {
    const Index x = i % 50, y = i / 50 % 50, z = i / 2500;
    if ((x + y + z) % 2 == 0) voxels.set(x, y, z);
  }
  (void)extract_surface(voxels, {}, context);
  ExtractOptions umbrellas;
  umbrellas.adjacency = Adjacency::exterior;
  umbrellas.glue = Glue::umbrella;
  (void)extract_surface(voxels, umbrellas, context);
}

void run_meshes(const std::string& ending, const Context& context) {
  const TemporaryFolder folder;
  const std::string path = folder / ("m" + ending);
  {
    BinaryVolume voxels;
    const DigitalSurface surface = sphere(0.012, voxels, {1});
    const Eigen::VectorXd field = Eigen::VectorXd::LinSpaced(surface.vertex_count(), 0, 1);
    (void)write_result(path, {surface.flat(), {scalar_field("f", FieldOn::vertex, field)}},
                       context);
  }
  (void)count_polygons(read_mesh(path, context).view(), context);
}

const testing::StageRuns kRuns = {
    {"normals", run_normals},
    {"direct", [](const Context& c) { run_distances(0.02, HeatMethod::direct, c); }},
    {"bands", [](const Context& c) { run_distances(0.009, HeatMethod::bands, c); }},
    {"solvers", run_solvers},
    {"voxels", run_voxels},
    {"checkerboard", run_checkerboard},
    {"off", [](const Context& c) { run_meshes(".off", c); }},
    {"obj", [](const Context& c) { run_meshes(".obj", c); }},
    {"ply", [](const Context& c) { run_meshes(".ply", c); }},
    {"stl", [](const Context& c) { run_meshes(".stl", c); }},
    {"om", [](const Context& c) { run_meshes(".om", c); }}};

TEST(StageMemory, DISABLED_Child) { testing::record_stages(kRuns); }

TEST(StageMemory, IsAtMostWhatIsAskedForAndAtLeastAThird) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers take memory of their own";
#endif
  const auto compared =
      testing::expect_stages_within(kRuns, DSC_TEST_PROGRAM, "StageMemory.DISABLED_Child");
  for (const char* stage :
       {"read", "digitize", "compare labels", "scan", "extract", "link", "normals", "curvature",
        "laplacian pattern", "laplacian", "order unknowns", "factorize", "set up multigrid", "heat",
        "distance", "spectrum", "regularise", "write", "count"}) {
    EXPECT_EQ(compared.count(stage), 1U) << stage << " never took enough to compare";
  }
}

}  // namespace
}  // namespace dsc
