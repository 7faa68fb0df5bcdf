// The library is run, on good input and on bad, with standard output and error in a file: nothing
// comes.
#include "libdsc/algorithms/diffusion.h"
#include "libdsc/algorithms/geodesic.h"
#include "libdsc/algorithms/mean_curvature.h"
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
#include "libdsc/render/picture.h"
#include "libdsc/render/png_file.h"
#include "libdsc/solve/cholmod_solver.h"
#include "libdsc/solve/multigrid.h"
#include "libdsc/solve/spectrum.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/expression.h"
#include "libdsc/voxels/shape_spec.h"
#include "tests/io/sample_meshes.h"
#include "tests/io/temporary_folder.h"
#include "tests/solve/grid_systems.h"
#include "tests/support/random_volume.h"

#include <gtest/gtest.h>

#include <cmath>
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

/// What calls did. Nothing is told of them at once: that would be printed.
class Calls {
 public:
  /// Has to give an answer.
  template <class Call>
  void good(const std::string& name, const Call& call) {
    try {
      call();
      ++answers_;
    } catch (const std::exception& error) {
      wrong_ += "\n" + name + ": " + error.what();
    }
  }
  /// Has to be refused.
  template <class Call>
  void bad(const std::string& name, const Call& call) {
    try {
      call();
      wrong_ += "\n" + name + ": nothing was thrown";
    } catch (const Error&) {
      ++refusals_;
    } catch (const std::exception& error) {
      wrong_ += "\n" + name + ": no error of the library: " + error.what();
    }
  }
  /// May do either.
  template <class Call>
  void any(const Call& call) {
    try {
      call();
    } catch (const Error&) {
    }
  }

  int answers() const { return answers_; }
  int refusals() const { return refusals_; }
  const std::string& wrong() const { return wrong_; }

 private:
  int answers_ = 0, refusals_ = 0;
  std::string wrong_;
};

Result result_of(const FlatMesh& mesh) {
  Result result;
  result.mesh = mesh;
  return result;
}

/// What is computed of a surface that has faces.
void compute_on(const FlatMesh& mesh, Calls& calls) {
  const std::vector<VertexId> source{0};
  calls.good("regularise", [&] { (void)regularise_positions(mesh); });
  calls.good("mean curvature", [&] { (void)mean_curvature(mesh, mesh.positions, {}); });
  for (const HeatMethod method : {HeatMethod::direct, HeatMethod::bands}) {
    GeodesicOptions geodesic;
    geodesic.method = method;
    calls.good("geodesic", [&] { (void)geodesic_distance(mesh, source, geodesic); });
    calls.bad("no source", [&] { (void)geodesic_distance(mesh, {}, geodesic); });
  }
  calls.good("spectrum", [&] {
    const LaplaceSystem system = assemble_laplacian(mesh);
    (void)lowest_spectrum(-system.L, system.mass, {.count = 5});
  });
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(mesh.vertices());
  calls.good("diffusion", [&] { (void)diffuse(mesh, one, 0.1); });
  calls.bad("diffusion of NaN", [&] { (void)diffuse(mesh, std::nan("") * one, 0.1); });
  calls.bad("diffusion back in time", [&] { (void)diffuse(mesh, one, -1); });
  calls.good("Poisson", [&] { (void)solve_poisson(mesh, 0 * one); });
  calls.bad("Poisson of ones", [&] { (void)solve_poisson(mesh, one); });
  calls.bad("Poisson at no vertex", [&] {
    const VertexId none = -1;
    (void)solve_poisson(mesh, one, {&none, 1}, one);
  });
}

/// Files of a surface, whole and cut. An empty one is no mesh for each form.
void write_and_read(const FlatMesh& mesh, const TemporaryFolder& folder, Calls& calls) {
  const bool empty = mesh.faces() == 0;
  const auto meant = [&](const std::string& name, const auto& call) {
    empty ? calls.any(call) : calls.good(name, call);
  };
  const auto cuts_of = [&](const std::string& path, const std::string& part) {
    for (const std::size_t cut : {0UL, 10UL, 200UL, 5000UL}) {
      write_all(part, read_all(path).substr(0, cut));
      calls.any([&] { (void)read_mesh(part); });
    }
  };
  for (const std::string ending : {"ply", "vtp", "csv", "off", "obj", "stl", "om"}) {
    const std::string path = folder / ("a." + ending);
    meant("write ." + ending, [&] { (void)write_result(path, result_of(mesh)); });
    if (ending == "vtp" || ending == "csv") continue;  // not read
    meant("read ." + ending, [&] { (void)read_mesh(path); });
    if (std::filesystem::exists(path)) cuts_of(path, folder / ("part." + ending));
  }
  meant("write .glb", [&] { (void)render::write_glb(folder / "a.glb", result_of(mesh)); });
  const auto page = [&] { write_page(folder / "a.html", result_of(mesh)); };
  has_pages() ? meant("write .html", page) : calls.bad("write .html", page);
  for (const std::string& path : {folder / "a.none", folder / "nowhere/a.ply"}) {
    calls.bad("write " + path, [&] { (void)write_result(path, result_of(mesh)); });
  }
#ifdef DSC_WITH_PICTURES
  render::PictureOptions size;
  size.width = size.height = 40;
  const auto picture = [&] { render::write_png(folder / "a.png", render::draw(mesh, size).image); };
  meant("write .png", picture);
  size.width = 1;
  calls.bad("a picture of no width", picture);
#endif
  calls.bad("glb nowhere",
            [&] { (void)render::write_glb(folder / "nowhere/a.glb", result_of(mesh)); });
  calls.bad("page nowhere", [&] { write_page(folder / "nowhere/a.html", result_of(mesh)); });
  calls.bad("NaN", [&] {
    const Eigen::VectorXd nan = Eigen::VectorXd::Constant(mesh.vertices() + 1, std::nan(""));
    Result result = result_of(mesh);
    result.fields.push_back(scalar_field("f", FieldOn::vertex, nan));
    (void)write_result(folder / "a.ply", result);
  });
}

void run_on(const BinaryVolume& voxels, const TemporaryFolder& folder, Calls& calls) {
  for (const Glue glue : {Glue::pointel, Glue::umbrella}) {
    ExtractOptions options;
    options.glue = glue;
    DigitalSurface surface = extract_surface(voxels, options);
    const DigitalSurface copy = surface;
    IntegralInvariantOptions ball;
    ball.radius = 3;
    calls.good("normals", [&] { integral_invariant_normals(surface, voxels, ball); });
    calls.good("trivial", [&] { trivial_normals(surface); });
    for (const CurvatureForm form : {CurvatureForm::centred, CurvatureForm::plain}) {
      calls.good("curvatures", [&] {
        (void)integral_invariant_curvatures(voxels, surface.surfels(), {3, form});
      });
    }
    calls.bad("curvatures without a ball",
              [&] { (void)integral_invariant_curvatures(voxels, surface.surfels(), {}); });
    const FlatMesh mesh = surface.flat();
    if (mesh.faces() > 0) compute_on(mesh, calls);
    write_and_read(mesh, folder, calls);
  }
  for (const std::string name : {"v.vol", "v.longvol", "v.npy", "v.vti"}) {
    const std::string path = folder / name;
    calls.good("write " + name, [&] { write_volume(path, voxels); });
    calls.good("read " + name, [&] { (void)read_binary(path); });
    calls.good("labels of " + name, [&] { (void)read_labels(path); });
    write_all(path, read_all(path).substr(0, 100));
    calls.bad("cut " + name, [&] { (void)read_binary(path); });
    calls.bad("cut labels of " + name, [&] { (void)read_labels(path); });
  }
}

void run_on_labels(const TemporaryFolder& folder, Calls& calls) {
  std::mt19937 random(4);
  LabelVolume labels(Grid{{9, 8, 7}, {1, 1, 1}, Vec3::Zero()}, 2);
  for (Index i = 0; i < 9 * 8 * 7; ++i) labels.set(i % 9, i / 9 % 8, i / 72, random() % 5);
  for (const char* name : {"l.vol", "l.longvol", "l.npy", "l.vti"}) {
    calls.good(name, [&] { write_volume(folder / name, labels); });
    calls.good(name, [&] { labels = read_labels(folder / name); });
  }
  DigitalSurface surface = extract_surface(labels);
  IntegralInvariantOptions ball;
  ball.radius = 3;
  calls.good("normals of labels", [&] { integral_invariant_normals(surface, labels, ball); });
  calls.bad("normals of other labels",
            [&] { integral_invariant_normals(surface, LabelVolume(), ball); });
  compute_on(surface.flat(), calls);
  write_and_read(surface.flat(), folder, calls);
  labels.set(3, 3, 3, 300);
  calls.bad("a wide label", [&] { write_volume(folder / "l.vol", labels); });
}

void run_on_text(Calls& calls) {
  const Vec3 p(1, 2, 3);
  calls.good("expression", [&] { (void)Expression("sin(x)*y+max(z,1)")(p); });
  for (const char* text : {"", "sin(", "x=3", "unknown(x)", "x y", "\x01"}) {
    calls.bad(text, [&] { (void)Expression(text); });
  }
  for (const char* text : {"1/(x-1)", "ln(-x)", "exp(exp(exp(exp(y))))"}) {
    calls.bad(text, [&] { (void)Expression(text)(p); });
  }
  for (const char* shape : {"sphere,r=2", "torus", "goursat", "heart", "plane,size=2",
                            "expr:x^2+y^2+z^4-1;box=-1.1,1.1"}) {
    calls.good(shape, [&] { (void)digitize(*make_shape(shape), {0.25, 0.25, 0.25}); });
  }
  for (const char* shape :
       {"", "none", "sphere,r=-1", "sphere,q=1", "expr:x", "expr:x;box=1,0", "expr:1/0;box=-1,1"}) {
    calls.bad(shape, [&] { (void)digitize(*make_shape(shape), {0.5, 0.5, 0.5}); });
  }
}

/// The readers that are processes of their own say nothing on the caller's standard error either;
/// where they are not built, the endings are refused.
void run_on_images(const TemporaryFolder& folder, Calls& calls) {
  for (const char* name :
       {"g.nii", "g.nii.gz", "g.nrrd", "g.mha", "g.tif", "g.vdb", "g.vox", "missing/v.vol"}) {
    if (name[0] == 'g')
      write_all(folder / name, "nothing that it could be" + std::string(900, 'x'));
    calls.bad(name, [&] { (void)read_binary(folder / name); });
  }
}

TEST(Silence, NothingIsPrintedOnGoodInputNorOnBad) {
  const TemporaryFolder folder;
  Calls calls;
  {
    const Captured captured(folder / "printed");
    run_on(testing::box_volume({12, 12, 12}, {2, 2, 2}, {9, 8, 7}), folder, calls);
    run_on(testing::random_volume({8, 8, 8}, 0.5, 1), folder, calls);  // pinched everywhere
    run_on(testing::random_volume({3, 1, 1}, 0., 1), folder, calls);   // empty
    run_on_labels(folder, calls);
    run_on_text(calls);
    run_on_images(folder, calls);
    for (const PolygonMesh& mesh : {test::mixed_mesh(), test::junction_mesh()}) {
      calls.any([&] { (void)assemble_laplacian(mesh.view()); });
      for (const char* name : {"m.om", "m.off", "m.ply"}) {
        calls.good(name, [&] { (void)write_result(folder / name, mesh.result()); });
        calls.good(name, [&] { (void)read_mesh(folder / name); });
      }
    }
    // Solvers of others on what they do not like.
    const SparseMatrix L = testing::grid_laplacian(70, 70);
    for (const double shift : {0., -0.5, 1.}) {
      const SparseMatrix A = L + shift * testing::identity(4900);
      for (const SolverMethod method : {SolverMethod::ldlt, SolverMethod::multigrid}) {
        const auto solve = [&] {
          (void)make_spd_solver(A, {method})->solve(testing::scrambled(4900));
        };
        shift > 0 ? calls.good("definite", solve) : calls.bad("not definite", solve);
      }
#ifdef DSC_WITH_CHOLMOD
      const auto cholmod = [&] { (void)make_cholmod_solver(A)->solve(testing::scrambled(4900)); };
      shift > 0 ? calls.good("CHOLMOD", cholmod) : calls.bad("not for CHOLMOD", cholmod);
#endif
      calls.any([&] { (void)lowest_spectrum(A, Eigen::VectorXd::Ones(4900), {.count = 6}); });
    }
  }
  EXPECT_EQ(read_all(folder / "printed"), "");
  EXPECT_EQ(calls.wrong(), "");
  EXPECT_GT(calls.answers(), 150);
  EXPECT_GT(calls.refusals(), 100);
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
