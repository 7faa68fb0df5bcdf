// Each stage takes at most what it asks for and at least a third of it. Measured in a process of
// its own, whose peak is reset where a stage asks.
#include "libdsc/algorithms/geodesic.h"
#include "libdsc/algorithms/poisson.h"
#include "libdsc/algorithms/regularise.h"
#include "libdsc/calculus/assembly.h"
#include "libdsc/io/memory_limit.h"
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
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/shapes.h"
#include "tests/io/temporary_folder.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <set>
#include <sstream>

#include <malloc.h>

namespace dsc {
namespace {

/// The highest resident size since the last reset, in bytes.
Index peak_bytes() {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("VmHWM:", 0) == 0) return std::stoll(line.substr(6)) * 1024;
  }
  throw std::runtime_error("no VmHWM in /proc/self/status");
}

void reset_peak() { write_all("/proc/self/clear_refs", "5"); }

/// Notes what every stage asks for and what the process then takes until the next one asks.
class Recorder final : public MemoryLimit {
 public:
  struct Stage {
    std::string name;
    Index asked = 0, taken = 0;
  };

  void need(std::string_view stage, Index bytes) const override {
    if (!stages_.empty()) stages_.back().taken = peak_bytes() - held_;
    if (!stages_.empty() && stages_.back().name == stage) {  // a part of the same
      stages_.back().asked += bytes;
      return;
    }
    (void)::malloc_trim(0);  // what was freed must not serve again unseen
    reset_peak();
    held_ = resident_bytes();
    stages_.push_back({std::string(stage), bytes, 0});
  }
  Index left() const override { return Index{1} << 40; }

  const std::vector<Stage>& finish() {
    need("end", 0);
    stages_.pop_back();
    return stages_;
  }

 private:
  mutable std::vector<Stage> stages_;
  mutable Index held_ = 0;
};

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
  (void)read_mesh(path, context);
}

const std::map<std::string, std::function<void(const Context&)>> kRuns = {
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

/// The process of its own: not a test, but what one starts.
TEST(StageMemory, DISABLED_Child) {
  const char* run = std::getenv("DSC_STAGE_RUN");
  ASSERT_NE(run, nullptr);
  Recorder recorder;
  kRuns.at(run)({1, nullptr, &recorder});
  std::ofstream out(std::getenv("DSC_STAGE_OUTPUT"));
  for (const auto& stage : recorder.finish()) {
    out << stage.asked << ' ' << stage.taken << ' ' << stage.name << '\n';
  }
}

TEST(StageMemory, IsAtMostWhatIsAskedForAndAtLeastAThird) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers take memory of their own";
#endif
  constexpr Index kSlack = Index{3} << 20;  // what allocators and the system take in pages
  const TemporaryFolder folder;
  std::set<std::string> compared;
  for (const auto& [name, run] : kRuns) {
    const std::string output = folder / name;
    const std::string command = "DSC_STAGE_RUN=" + name + " DSC_STAGE_OUTPUT='" + output +
                                "' '" DSC_TEST_PROGRAM
                                "' --gtest_also_run_disabled_tests "
                                "--gtest_filter=StageMemory.DISABLED_Child > '" +
                                folder / "log" + "' 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0) << name << "\n" << read_all(folder / "log");
    std::istringstream lines(read_all(output));
    Index asked = 0, taken = 0;
    std::string stage;
    while (lines >> asked >> taken && std::getline(lines >> std::ws, stage)) {
      if (stage == "between") continue;
      SCOPED_TRACE(name + ": " + stage + ", asked " + bytes_text(asked) + ", taken " +
                   bytes_text(taken));
      RecordProperty(name + " " + stage, bytes_text(asked) + " " + bytes_text(taken));
      if (std::getenv("DSC_STAGE_PRINT") != nullptr) {
        std::printf("%-14s %-20s asked %10s taken %10s  %.2f\n", name.c_str(), stage.c_str(),
                    bytes_text(asked).c_str(), bytes_text(taken).c_str(),
                    static_cast<double>(taken) / static_cast<double>(asked));
      }
      EXPECT_LE(taken, asked + kSlack);
      if (asked < 2 * kSlack) continue;
      EXPECT_GE(3 * taken, asked);
      compared.insert(stage);
    }
  }
  for (const char* stage :
       {"read", "digitize", "compare labels", "scan", "extract", "link", "normals", "curvature",
        "laplacian pattern", "laplacian", "order unknowns", "factorize", "set up multigrid", "heat",
        "distance", "spectrum", "regularise", "write"}) {
    EXPECT_EQ(compared.count(stage), 1U) << stage << " never took enough to compare";
  }
}

}  // namespace
}  // namespace dsc
