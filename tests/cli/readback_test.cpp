// What the program writes, opened by others: CGAL's polygon soup readers, OpenMesh's own, and an
// XML parser without VTK. On a sphere, on real voxels and on all regions of a brain atlas.
#include "tests/cli/program.h"
#include "tests/io/result_parsers.h"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <filesystem>

namespace dsc::test {
namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;
using OpenMeshMesh = OpenMesh::PolyMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

const std::string kAtlas = "/usr/share/mricron/templates/aal.nii.gz";

struct Soup {
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> polygons;
};

Soup read_by_cgal(const std::string& path) {
  Soup soup;
  EXPECT_TRUE(CGAL::IO::read_polygon_soup(path, soup.points, soup.polygons)) << path;
  return soup;
}

std::size_t faces_by_openmesh(const std::string& path) {
  OpenMeshMesh mesh;
  EXPECT_TRUE(OpenMesh::IO::read_mesh(mesh, path)) << path;
  return mesh.n_faces();
}

/// Runs `words` with an output of every form and reads each back.
void check_outputs(Words words, bool manifold) {
  const Folder folder;
  for (const char* ending : {"ply", "off", "obj", "stl", "om", "vtp"}) {
    words.insert(words.end(), {"-o", folder / (std::string("result.") + ending)});
  }
  words.insert(words.end(), {"--quiet", "--report", folder / "report.json"});
  const Outcome outcome = run_dsc(words);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto report = read_json(folder / "report.json");
  const auto vertices = report["surface"]["vertices"].get<std::size_t>();
  const auto faces = report["surface"]["faces"].get<std::size_t>();
  ASSERT_GT(faces, 0U);

  for (const char* ending : {"ply", "off", "obj"}) {
    const Soup soup = read_by_cgal(folder / (std::string("result.") + ending));
    EXPECT_EQ(soup.points.size(), vertices) << ending;
    EXPECT_EQ(soup.polygons.size(), faces) << ending;
    for (const auto& polygon : soup.polygons) ASSERT_EQ(polygon.size(), 4U) << ending;
  }
  EXPECT_EQ(read_by_cgal(folder / "result.stl").polygons.size(), 2 * faces);
  EXPECT_EQ(faces_by_openmesh(folder / "result.om"), faces);
  if (manifold) {  // OpenMesh's readers drop faces at other edges
    for (const char* ending : {"ply", "off", "obj"}) {
      EXPECT_EQ(faces_by_openmesh(folder / (std::string("result.") + ending)), faces) << ending;
    }
  }
  const VtpFile vtp = read_vtp(folder / "result.vtp");
  EXPECT_EQ(static_cast<std::size_t>(vtp.points), vertices);
  EXPECT_EQ(static_cast<std::size_t>(vtp.polys), faces);
}

void check_commands(const Words& input, bool manifold) {
  for (const Words& command :
       {Words{"surface"}, Words{"normals"}, Words{"gradient", "--function", "x*y"},
        Words{"geodesic", "--source-vertex", "0"}}) {
    SCOPED_TRACE(command[0]);
    Words words = command;
    words.insert(words.end(), input.begin(), input.end());
    check_outputs(words, manifold);
  }
}

TEST(Readback, OfASphereIsWhole) {
  check_commands({"shape:sphere", "--gridstep", "0.1"}, true);
  check_outputs({"curvature", "shape:sphere", "--gridstep", "0.1"}, true);
}

TEST(Readback, OfRealVoxelsIsWhole) {
  const std::string spot = test_data("spot-128.vol");
  if (spot.empty()) GTEST_SKIP() << "DSC_TEST_DATA is not set";
  check_commands({spot}, false);
  check_outputs({"curvature", spot}, false);
}

TEST(Readback, OfAllRegionsOfABrainIsWhole) {
#ifndef DSC_IMAGE_READER
  GTEST_SKIP() << "built without DSC_WITH_ITK";
#endif
  if (!std::filesystem::exists(kAtlas)) GTEST_SKIP() << "the package mricron-data is not installed";
  check_outputs({"normals", kAtlas, "--labels", "all"}, false);
  check_outputs({"curvature", kAtlas}, false);
}

}  // namespace
}  // namespace dsc::test
