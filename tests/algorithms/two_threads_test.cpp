// Two callers at once, each on a surface of its own or both on one: the library has no state that
// they share. Under ThreadSanitizer (preset tsan) a race is an error.
#include "libdsc/algorithms/diffusion.h"
#include "libdsc/algorithms/geodesic.h"
#include "libdsc/algorithms/poisson.h"
#include "libdsc/algorithms/regularise.h"
#include "libdsc/base/error.h"
#include "libdsc/calculus/assembly.h"
#include "libdsc/io/mesh_reader.h"
#include "libdsc/io/read_binary.h"
#include "libdsc/io/read_labels.h"
#include "libdsc/io/results.h"
#include "libdsc/io/volume_writer.h"
#include "libdsc/normals/curvature.h"
#include "libdsc/normals/surface_normals.h"
#include "libdsc/page/page.h"
#include "libdsc/render/glb_file.h"
#include "libdsc/solve/spectrum.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/expression.h"
#include "libdsc/voxels/shape_spec.h"
#include "tests/io/temporary_folder.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace dsc {
namespace {

/// All that a run computes, and the bytes of its files.
struct Outcome {
  std::vector<double> numbers;
  std::vector<std::string> files;

  void add(const Eigen::Ref<const Eigen::MatrixXd>& m) {
    for (Index j = 0; j < m.cols(); ++j) {
      for (Index i = 0; i < m.rows(); ++i) numbers.push_back(m(i, j));
    }
  }
  void add(Vec3View points) {
    for (Index i = 0; i < points.size; ++i) add(points[i]);
  }
  friend bool operator==(const Outcome&, const Outcome&) = default;
};

/// A shape as voxels, as labels (its two halves) and as a surface.
struct Scene {
  BinaryVolume voxels;
  LabelVolume labels;
  DigitalSurface surface;
  IntegralInvariantOptions ball;
};

Scene scene_of(const std::string& shape, double h, const Context& context) {
  const auto implicit = make_shape(shape);
  Scene scene{digitize(*implicit, {h, h, h}, context), {}, {}, {}};
  const Grid& grid = scene.voxels.grid();
  scene.labels = LabelVolume(grid, 1);
  for (Index z = 0; z < grid.size[2]; ++z) {
    for (Index y = 0; y < grid.size[1]; ++y) {
      for (Index x = 0; x < grid.size[0]; ++x) {
        if (scene.voxels(x, y, z)) scene.labels.set(x, y, z, 2 * x < grid.size[0] ? 1 : 2);
      }
    }
  }
  scene.surface = extract_surface(scene.voxels, {}, context);
  scene.ball.radius = 4 * h;
  integral_invariant_normals(scene.surface, scene.voxels, scene.ball, context);
  return scene;
}

void measure_voxels(const Scene& scene, const Context& context, Outcome& out) {
  const TemporaryFolder folder;
  for (const char* name : {"v.vol", "v.longvol", "v.npy", "v.vti"}) {
    write_volume(folder / name, scene.voxels, {}, context);
    out.files.push_back(read_all(folder / name));
    EXPECT_EQ(read_binary(folder / name, {}, context).count(), scene.voxels.count()) << name;
    write_volume(folder / name, scene.labels, {}, context);
    out.files.push_back(read_all(folder / name));
    EXPECT_EQ(read_labels(folder / name, context).count(context), scene.voxels.count()) << name;
  }
  DigitalSurface halves = extract_surface(scene.labels, {}, context);
  integral_invariant_normals(halves, scene.labels, scene.ball, context);
  out.add(halves.flat().positions);
  out.add(halves.normals());
  const CurvatureField curvature = integral_invariant_curvatures(
      scene.voxels, scene.surface.surfels(), {scene.ball.radius}, context);
  out.add(curvature.mean);
  out.add(curvature.direction_1);
}

void measure(const Scene& scene, const std::string& path, const Context& context, Outcome& out) {
  measure_voxels(scene, context, out);
  const FlatMesh mesh = scene.surface.flat();
  const std::vector<VertexId> sources{0, 100};
  const Eigen::VectorXd f = Expression("x^2 + sin(y) * z")(mesh.positions, context);
  out.add(f);
  const Eigen::VectorXd distance = geodesic_distance(mesh, sources, {}, context).distance;
  out.add(distance);
  GeodesicOptions direct;
  direct.method = HeatMethod::direct;
  out.add(geodesic_distance(mesh, sources, direct, context).distance);
  out.add(HeatDiffusion(mesh, 0.01, {}, context).step(f, context).x);
  PoissonOptions poisson;
  poisson.solver.method = SolverMethod::multigrid;
  const PoissonProblem problem(mesh, {}, poisson, context);
  Eigen::VectorXd b = problem.mass().cwiseProduct(f);
  b.array() -= b.mean();
  out.add(problem.solve(b, {}, context).x);
  const LaplaceSystem system = assemble_laplacian(mesh, {}, context);
  out.add(lowest_spectrum(-system.L, system.mass, {.count = 4}, context).values);
  out.add(regularise_positions(mesh, {}, context).positions);
  Result result;
  result.mesh = mesh;
  result.fields.push_back(scalar_field("distance", FieldOn::vertex, distance));
  write_result(path, result, context);
  out.files.push_back(read_all(path));
  out.add(read_mesh(path, context).positions);
  const TemporaryFolder folder;  // a page has its file's name in it
  (void)render::write_glb(folder / "s.glb", result, context);
  out.files.push_back(read_all(folder / "s.glb"));
  if (!has_pages()) return;
  write_page(folder / "s.html", result, context);
  out.files.push_back(read_all(folder / "s.html"));
}

Outcome whole_run(const std::string& shape, const std::string& path, const Context& context) {
  Outcome out;
  measure(scene_of(shape, 0.1, context), path, context, out);
  return out;
}

void side_by_side(const std::vector<std::function<void()>>& calls) {
  std::atomic<std::size_t> ready{0};
  std::vector<std::thread> threads;
  for (const auto& call : calls) {
    threads.emplace_back([&, call] {
      ++ready;
      while (ready < calls.size()) std::this_thread::yield();
      call();
    });
  }
  for (std::thread& t : threads) t.join();
}

TEST(TwoThreads, OnTwoSurfacesComputeWhatEachDoesAlone) {
  const TemporaryFolder folder;
  const std::string shapes[] = {"sphere", "torus,R=1,r=0.5"};
  for (const std::string ending : {".ply", ".om", ".obj"}) {
    const Outcome alone[] = {whole_run(shapes[0], folder / ("a" + ending), Context{1}),
                             whole_run(shapes[1], folder / ("b" + ending), Context{1})};
    Outcome together[2];
    side_by_side(
        {[&] { together[0] = whole_run(shapes[0], folder / ("c" + ending), Context{2}); },
         [&] { together[1] = whole_run(shapes[1], folder / ("d" + ending), Context{1}); }});
    for (int i : {0, 1}) EXPECT_TRUE(alone[i] == together[i]) << ending << ", " << shapes[i];
  }
}

TEST(TwoThreads, OnOneSurfaceComputeTheSame) {
  const TemporaryFolder folder;
  const Scene scene = scene_of("sphere", 0.1, {});
  Outcome a, b;
  side_by_side({[&] { measure(scene, folder / "a.ply", Context{2}, a); },
                [&] { measure(scene, folder / "b.ply", Context{1}, b); }});
  EXPECT_TRUE(a == b);
}

TEST(TwoThreads, ManyRoundsSideBySideGiveTheFirstResult) {
  const Scene scenes[] = {scene_of("sphere", 0.12, {}), scene_of("torus,R=1,r=0.5", 0.15, {})};
  const std::vector<VertexId> source{7};
  const auto rounds = [&](const DigitalSurface& surface, int& different) {
    const FlatMesh mesh = surface.flat();
    const Eigen::VectorXd first = geodesic_distance(mesh, source, {}, Context{1}).distance;
    for (int round = 0; round < 40; ++round) {
      different += geodesic_distance(mesh, source, {}, Context{1}).distance == first ? 0 : 1;
    }
  };
  int different[2] = {0, 0};
  side_by_side({[&] { rounds(scenes[0].surface, different[0]); },
                [&] { rounds(scenes[1].surface, different[1]); }});
  EXPECT_EQ(different[0], 0);
  EXPECT_EQ(different[1], 0);
}

TEST(TwoThreads, OneIsCancelledAndTheOtherGoesOn) {
  const TemporaryFolder folder;
  const Outcome alone = whole_run("sphere", folder / "a.ply", Context{1});
  Monitor monitor;
  Outcome goes_on;
  std::atomic<bool> ended_early{false};
  side_by_side({[&] { goes_on = whole_run("sphere", folder / "b.ply", Context{1}); },
                [&] {
                  try {
                    for (;;)
                      (void)whole_run("torus,R=1,r=0.5", folder / "c.ply", Context{2, &monitor});
                  } catch (const Cancelled&) {
                    ended_early = true;
                  }
                },
                [&] {
                  std::this_thread::sleep_for(std::chrono::milliseconds(30));
                  monitor.cancel();
                }});
  EXPECT_TRUE(ended_early);
  EXPECT_TRUE(alone == goes_on);
}

}  // namespace
}  // namespace dsc
