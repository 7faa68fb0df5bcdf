// The library is run, on good input and on bad, with standard output and error in a file: nothing
// comes.
#include "libdsc/algorithms/geodesic.h"
#include "libdsc/algorithms/mean_curvature.h"
#include "libdsc/algorithms/regularise.h"
#include "libdsc/base/error.h"
#include "libdsc/calculus/assembly.h"
#include "libdsc/io/mesh_reader.h"
#include "libdsc/io/read_binary.h"
#include "libdsc/io/results.h"
#include "libdsc/io/volume_writer.h"
#include "libdsc/normals/curvature.h"
#include "libdsc/normals/surface_normals.h"
#include "libdsc/solve/multigrid.h"
#include "libdsc/solve/spectrum.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "tests/io/sample_meshes.h"
#include "tests/io/temporary_folder.h"
#include "tests/solve/grid_systems.h"
#include "tests/support/random_volume.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <iostream>

#include <fcntl.h>

namespace dsc {
namespace {

/// Sends what goes to the files 1 and 2 to a file of the folder while it lives.
class Captured {
 public:
  explicit Captured(const std::string& path) : saved_{::dup(1), ::dup(2)} {
    flush();
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(file, 1);
    ::dup2(file, 2);
    ::close(file);
  }
  Captured(const Captured&) = delete;
  Captured& operator=(const Captured&) = delete;
  ~Captured() {
    flush();
    for (const int i : {0, 1}) {
      ::dup2(saved_[i], i + 1);
      ::close(saved_[i]);
    }
  }

 private:
  static void flush() {
    std::fflush(nullptr);
    std::cout.flush();
    std::cerr.flush();
    std::clog.flush();
  }
  int saved_[2];
};

template <class Call>
void ignoring_errors(const Call& call) {
  try {
    call();
  } catch (const std::exception&) {
  }
}

void run_on(const BinaryVolume& voxels, const TemporaryFolder& folder) {
  for (const Glue glue : {Glue::pointel, Glue::umbrella}) {
    ExtractOptions options;
    options.glue = glue;
    DigitalSurface surface = extract_surface(voxels, options);
    const DigitalSurface copy = surface;
    IntegralInvariantOptions ball;
    ball.radius = 3;
    ignoring_errors([&] { integral_invariant_normals(surface, voxels, ball); });
    ignoring_errors([&] { trivial_normals(surface); });
    const FlatMesh mesh = surface.flat();
    ignoring_errors([&] { (void)regularise_positions(mesh); });
    for (const HeatMethod method : {HeatMethod::direct, HeatMethod::bands}) {
      GeodesicOptions geodesic;
      geodesic.method = method;
      const VertexId source = 0;
      ignoring_errors([&] { (void)geodesic_distance(mesh, {&source, 1}, geodesic); });
      ignoring_errors([&] { (void)geodesic_distance(mesh, {}, geodesic); });
    }
    ignoring_errors([&] {
      const LaplaceSystem system = assemble_laplacian(mesh);
      (void)lowest_spectrum(-system.L, system.mass, {.count = 5});
    });
    for (const char* ending : {"ply", "vtp", "csv", "off", "obj", "stl", "om", "none"}) {
      const std::string path = folder / (std::string("a.") + ending);
      Result result;
      result.mesh = mesh;
      ignoring_errors([&] { (void)write_result(path, result); });
      ignoring_errors([&] { (void)read_mesh(path); });
      for (const std::size_t cut : {0UL, 10UL, 200UL, 5000UL}) {
        ignoring_errors([&] {
          const std::string bytes = read_all(path);
          const std::string part = folder / (std::string("part.") + ending);
          write_all(part, bytes.substr(0, cut));
          (void)read_mesh(part);
        });
      }
    }
  }
  for (const char* name : {"v.vol", "v.longvol", "v.npy"}) {
    ignoring_errors([&] { write_volume(folder / name, voxels); });
    ignoring_errors([&] { (void)read_binary(folder / name); });
    ignoring_errors([&] {
      write_all(folder / name, read_all(folder / name).substr(0, 100));
      (void)read_binary(folder / name);
    });
  }
}

TEST(Silence, NothingIsPrintedOnGoodInputNorOnBad) {
  const TemporaryFolder folder;
  {
    const Captured captured(folder / "printed");
    run_on(testing::box_volume({12, 12, 12}, {2, 2, 2}, {9, 8, 7}), folder);
    run_on(testing::random_volume({8, 8, 8}, 0.5, 1), folder);  // pinched everywhere
    run_on(testing::random_volume({3, 1, 1}, 0., 1), folder);   // empty
    for (const PolygonMesh& mesh : {test::mixed_mesh(), test::junction_mesh()}) {
      ignoring_errors([&] { (void)assemble_laplacian(mesh.view()); });
      for (const char* name : {"m.om", "m.off", "m.ply"}) {
        ignoring_errors([&] { (void)write_result(folder / name, mesh.result()); });
        ignoring_errors([&] { (void)read_mesh(folder / name); });
      }
    }
    // Solvers of others on what they do not like.
    const SparseMatrix L = testing::grid_laplacian(70, 70);
    for (const double shift : {0., -0.5, 1.}) {
      const SparseMatrix A = L + shift * testing::identity(4900);
      for (const SolverMethod method : {SolverMethod::ldlt, SolverMethod::multigrid}) {
        ignoring_errors(
            [&] { (void)make_spd_solver(A, {method})->solve(testing::scrambled(4900)); });
      }
      ignoring_errors([&] { (void)lowest_spectrum(A, Eigen::VectorXd::Ones(4900), {.count = 6}); });
    }
  }
  EXPECT_EQ(read_all(folder / "printed"), "");
}

TEST(Silence, TheCaptureSeesWhatIsPrinted) {
  const TemporaryFolder folder;
  {
    const Captured captured(folder / "printed");
    std::cout << "a";
    std::fputs("b", stderr);
  }
  EXPECT_EQ(read_all(folder / "printed").size(), 2U);
}

}  // namespace
}  // namespace dsc
