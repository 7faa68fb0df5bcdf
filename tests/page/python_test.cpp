// Pages opened by Python's html.parser, json, base64 and zlib: what the browser's decoder finds is
// there by the description of the format alone.
#include "libdsc/normals/surface_normals.h"
#include "libdsc/page/page.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/shapes.h"
#include "tests/io/python_check.h"
#include "tests/io/sample_meshes.h"

#include <gtest/gtest.h>

#include <limits>

namespace dsc {
namespace {

#ifdef DSC_PYTHON

/// What the truth is, that a test may make false.
struct PageTruth {
  std::vector<double> positions, scalar, vector, normals;
  std::string faces;
  bool lattice = false;

  void write(const TemporaryFolder& folder) const {
    write_all(folder / "truth.json",
              "{\"positions\":" + test::json_list(positions) + ",\"faces\":" + faces +
                  ",\"scalar\":" + test::json_list(scalar) + ",\"vector\":" +
                  test::json_list(vector) + ",\"normals\":" + test::json_list(normals) +
                  ",\"lattice\":" + (lattice ? "true" : "false") +
                  ",\"fields\":[[\"heat\",\"vertex\",1],[\"flow\",\"face\",3]]}");
  }
};

/// Writes s.html of a mesh with two fields. \return what is in it.
PageTruth write_with_fields(const TemporaryFolder& folder, const FlatMesh& mesh, bool lattice) {
  const auto numbers = [](Vec3View v) {
    return std::vector<double>(v.matrix().data(), v.matrix().data() + 3 * v.size);
  };
  PageTruth truth;
  truth.positions = numbers(mesh.positions);
  if (mesh.has_normals()) truth.normals = numbers(mesh.normals);
  truth.faces = test::json_faces(mesh);
  truth.lattice = lattice;
  std::mt19937_64 random(5);
  for (Index v = 0; v < mesh.vertices(); ++v) truth.scalar.push_back(test::odd_double(random));
  truth.scalar[1] = std::numeric_limits<double>::infinity();
  for (Index i = 0; i < 3 * mesh.faces(); ++i) {  // far from what floats hold
    truth.vector.push_back(1e-200 * test::odd_double(random));
  }
  Result result;
  result.mesh = mesh;
  result.fields.push_back(scalar_field("heat", FieldOn::vertex, truth.scalar));
  result.fields.push_back({"flow", {"fx", "fy", "fz"}, FieldOn::face, truth.vector});
  write_page(folder / "s.html", result);
  truth.write(folder);
  return truth;
}

PageTruth write_polygons(const TemporaryFolder& folder) {
  PolygonMesh mesh = test::mixed_mesh();
  std::mt19937_64 random(6);
  mesh.normals.resize(3, std::ssize(mesh.offsets) - 1);
  for (double& x : mesh.normals.reshaped()) x = std::normal_distribution<double>()(random);
  mesh.normals.colwise().normalize();
  return write_with_fields(folder, mesh.view(), false);
}

DigitalSurface surface() {
  DigitalSurface made = extract_surface(digitize(Torus(), {0.3, 0.25, 0.4}));
  trivial_normals(made);
  return made;
}

TEST(PageByPython, HasTheMeshAndTheFields) {
  const TemporaryFolder folder;
  std::string said;
  write_polygons(folder);
  EXPECT_EQ(test::check_by_python(folder.path(), "html", &said), 0) << said;
  const DigitalSurface made = surface();
  write_with_fields(folder, made.flat(), true);
  EXPECT_EQ(test::check_by_python(folder.path(), "html", &said), 0) << said;
}

/// A digit of the base64 of each block, and of the manifest.
TEST(PageByPython, SeesAChangedDigit) {
  const TemporaryFolder folder;
  write_polygons(folder);
  ASSERT_EQ(test::check_by_python(folder.path(), "html"), 0);
  const std::string bytes = read_all(folder / "s.html");
  const auto expect_seen = [&](std::size_t at, const std::string& what) {
    std::string changed = bytes, said;
    changed[at] = changed[at] == '7' ? '8' : '7';
    write_all(folder / "s.html", changed);
    EXPECT_EQ(test::check_by_python(folder.path(), "html", &said), 1) << what;
    EXPECT_NE(said.find("html"), std::string::npos) << said;
  };
  for (const std::string id :
       {"three", "positions", "corners", "sizes", "normals", "field0", "field1"}) {
    const std::string mark = "id=\"" + id + "\">";
    const std::size_t at = bytes.find(mark);
    ASSERT_NE(at, std::string::npos) << id;
    expect_seen(at + mark.size() + 20, id);
  }
  for (const std::string key : {"vertices", "faces", "corners", "origin", "step", "exponent"}) {
    const std::size_t at = bytes.find("\"" + key + "\":", bytes.find("id=\"manifest\">"));
    ASSERT_NE(at, std::string::npos) << key;
    expect_seen(bytes.find_first_of("0123456789", at), key);
  }
}

/// The blocks have checksums; so what they say is compared with something else, too.
TEST(PageByPython, SeesAnythingElseThanTheTruth) {
  const TemporaryFolder folder;
  const DigitalSurface made = surface();
  const PageTruth truth = write_with_fields(folder, made.flat(), true);
  const auto expect_seen = [&](const std::string& what, const auto& change) {
    PageTruth other = truth;
    change(other);
    other.write(folder);
    std::string said;
    EXPECT_EQ(test::check_by_python(folder.path(), "html", &said), 1) << what;
    EXPECT_NE(said.find(what), std::string::npos) << said;
  };
  expect_seen("points", [](PageTruth& t) { t.positions[100] += 1e-8; });
  expect_seen("faces", [](PageTruth& t) { t.faces[2] = t.faces[2] == '7' ? '8' : '7'; });
  const auto largest = [](std::vector<double>& values) -> double& {
    return *std::max_element(values.begin(), values.end(), [](double a, double b) {
      return std::isinf(b) ? false : std::isinf(a) || std::abs(a) < std::abs(b);
    });
  };
  expect_seen("heat", [&](PageTruth& t) { largest(t.scalar) *= 1 + 1e-6; });
  expect_seen("heat", [](PageTruth& t) { t.scalar[1] = 1e300; });
  expect_seen("flow", [&](PageTruth& t) { largest(t.vector) *= 1 + 1e-6; });
  expect_seen("normal", [](PageTruth& t) { t.normals[50] += 1e-3; });
}

#else
TEST(PageByPython, HasTheMeshAndTheFields) { GTEST_SKIP() << "there is no Python here"; }
#endif

}  // namespace
}  // namespace dsc
