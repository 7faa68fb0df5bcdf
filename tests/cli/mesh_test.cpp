// Meshes as input, through every command that takes them.
#include "libdsc/io/mesh_reader.h"
#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace dsc::test {
namespace {

const char* const kCube =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// The unit sphere as a cube of n x n quads a side, pushed outwards.
std::string sphere_off(int n) {
  std::map<std::array<int, 3>, int> ids;
  std::string vertices, faces;
  const auto vertex = [&](std::array<int, 3> at) {
    const auto [found, fresh] = ids.emplace(at, static_cast<int>(ids.size()));
    if (fresh) {
      Vec3 p;
      for (std::size_t k = 0; k < 3; ++k) {
        p[static_cast<int>(k)] = std::tan(0.7853981633974483 * (2. * at[k] / n - 1.));
      }
      p.normalize();
      for (const double x : p) vertices += std::to_string(x) + " ";
      vertices += "\n";
    }
    return found->second;
  };
  int count = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t a = (axis + 1) % 3, b = (axis + 2) % 3;
    for (const int side : {0, n}) {
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j, ++count) {
          const auto at = [&](int di, int dj) {
            std::array<int, 3> p{};
            p[axis] = side;
            p[a] = i + (side > 0 ? di : dj);
            p[b] = j + (side > 0 ? dj : di);
            return std::to_string(vertex(p));
          };
          // The low side is seen from outside the other way around.
          faces += "4 " + at(0, 0) + " " + at(1, 0) + " " + at(1, 1) + " " + at(0, 1) + "\n";
        }
      }
    }
  }
  return "OFF\n" + std::to_string(ids.size()) + " " + std::to_string(count) + " 0\n" + vertices +
         faces;
}

TEST(MeshInput, InfoCountsTheSoup) {
  const Folder folder;
  write_file(folder / "cube.obj", kCube);
  const auto cube = report_of({"info", folder / "cube.obj"});
  EXPECT_EQ(cube["input"]["kind"], "mesh");
  EXPECT_EQ(cube["input"]["normals"], false);
  EXPECT_EQ(cube["surface"]["vertices"], 8);
  EXPECT_EQ(cube["surface"]["edges"], 12);
  EXPECT_EQ(cube["surface"]["faces"], 6);
  EXPECT_EQ(cube["surface"]["euler"], 2);
  EXPECT_EQ(cube["surface"]["boundary_edges"], 0);
  write_file(folder / "pages.off",
             "OFF\n6 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 -1 0\n9 9 9\n3 0 1 2\n3 0 1 3\n3 0 1 4\n");
  const auto pages = report_of({"info", folder / "pages.off"});
  EXPECT_EQ(pages["surface"]["nonmanifold_edges"], 1);
  EXPECT_EQ(pages["surface"]["boundary_edges"], 6);
  EXPECT_EQ(pages["input"]["isolated_vertices"], 1);
  EXPECT_NE(run_dsc({"info", folder / "pages.off"}).out.find("1 non-manifold edge"),
            std::string::npos);
}

TEST(MeshInput, SurfaceConvertsBetweenAllForms) {
  const Folder folder;
  write_file(folder / "cube.obj", kCube);
  const PolygonMesh cube = read_mesh(folder / "cube.obj");
  std::string from = folder / "cube.obj";
  for (const char* ending : {".off", ".ply", ".om", ".obj", ".stl"}) {
    const std::string to = folder / (std::string("next") + ending);
    ASSERT_EQ(run_dsc({"surface", from, "-o", to}).exit_code, 0);
    const PolygonMesh mesh = read_mesh(to);
    if (ending == std::string(".stl")) {
      EXPECT_EQ(mesh.positions.cols(), 8);
      EXPECT_EQ(mesh.corners.size(), 36U);
    } else {
      EXPECT_EQ(mesh.positions, cube.positions) << ending;
      EXPECT_EQ(mesh.corners, cube.corners) << ending;
      EXPECT_EQ(mesh.offsets, cube.offsets) << ending;
    }
    from = to;
  }
}

TEST(MeshInput, NormalsAreTheFacesOwn) {
  const Folder folder;
  write_file(folder / "cube.obj", kCube);
  const auto report = report_of({"normals", folder / "cube.obj", "-o", folder / "n.ply"});
  EXPECT_EQ(report["normals"]["estimator"], "trivial");
  EXPECT_TRUE(report["warnings"].empty());
  const PolygonMesh mesh = read_mesh(folder / "n.ply");
  Eigen::Matrix3Xd expected(3, 6);
  expected << 0, 0, 0, 1, 0, -1,  //
      0, 0, -1, 0, 1, 0,          //
      -1, 1, 0, 0, 0, 0;
  EXPECT_EQ(mesh.normals, expected);
}

TEST(MeshInput, DistancesOnAMeshOfTheSphereAreThoseOfTheSphere) {
  const Folder folder;
  write_file(folder / "sphere.off", sphere_off(24));
  const auto report =
      report_of({"geodesic", folder / "sphere.off", "--source", "0,0,1", "-o", folder / "d.ply"});
  EXPECT_EQ(report["surface"]["euler"], 2);
  EXPECT_EQ(report["calculus"]["kind"], "naive");
  const PolygonMesh mesh = read_mesh(folder / "d.ply");
  ASSERT_EQ(mesh.fields.size(), 1U);
  double sum = 0;
  for (Index v = 0; v < mesh.positions.cols(); ++v) {
    const double exact = std::acos(std::clamp(mesh.positions(2, v), -1., 1.));
    sum += std::abs(mesh.fields[0].values[static_cast<std::size_t>(v)] - exact);
  }
  EXPECT_LT(sum / static_cast<double>(mesh.positions.cols()), 0.02);
}

/// A digital surface that went through a file is the same surface: its faces are now polygons, and
/// the general operators take the place of the closed form.
TEST(MeshInput, ADigitalSurfaceFromAFileGivesTheSameResults) {
  const Folder folder;
  const Words shape = {"shape:goursat", "--gridstep", "0.5"};
  ASSERT_EQ(run_dsc(Words{"normals"} + shape + Words{"-o", folder / "s.ply", "-o", folder / "s.om"})
                .exit_code,
            0);
  const std::vector<Words> commands = {
      {"geodesic", "--source", "3,3,3"},
      {"diffuse", "--source", "3,3,3", "--time", "1"},
      {"spectrum", "--count", "5"},
  };
  for (const Words& command : commands) {
    for (const char* calculus : {"projected", "naive"}) {
      for (const char* file : {"s.ply", "s.om"}) {
        SCOPED_TRACE(command[0] + " " + calculus + " " + file);
        const Words options = {"--calculus", calculus, "-o", folder / "a.ply"};
        const auto voxels = report_of(command + shape + options);
        const PolygonMesh expected = read_mesh(folder / "a.ply");
        const auto polygons = report_of(command + Words{folder / file} + options);
        const PolygonMesh found = read_mesh(folder / "a.ply");
        EXPECT_EQ(polygons["calculus"]["kind"], calculus);
        EXPECT_EQ(polygons["calculus"]["clamped_faces"], voxels["calculus"]["clamped_faces"]);
        EXPECT_EQ(found.positions, expected.positions);
        EXPECT_GT(found.normals.cols(), 0) << "the file's normals are kept";
        if (command[0] == "spectrum") {
          for (std::size_t k = 0; k < 5; ++k) {
            const double value = voxels["spectrum"]["eigenvalues"][k];
            EXPECT_NEAR(polygons["spectrum"]["eigenvalues"][k].get<double>(), value, 1e-6);
          }
          continue;
        }
        ASSERT_EQ(found.fields.size(), 1U);
        const double scale = voxels["result"]["max"];
        for (std::size_t v = 0; v < found.fields[0].values.size(); ++v) {
          ASSERT_NEAR(found.fields[0].values[v], expected.fields[0].values[v], 1e-6 * scale);
        }
      }
    }
  }
}

/// Faces of several labels meet at most edges here, so that .om holds a mesh in many pieces.
TEST(MeshInput, DistancesCrossTheJunctionsOfAMeshFile) {
  const Folder folder;
  constexpr int n = 9;
  std::mt19937 random(3);
  std::string labels;
  for (int i = 0; i < n * n * n; ++i) labels += static_cast<char>(random() % 4);
  write_file(folder / "labels.raw", labels);
  const Words voxels = {
      folder / "labels.raw", "--size", "9,9,9", "--type", "u8", "--labels", "all", "--radius", "3"};
  ASSERT_EQ(
      run_dsc(Words{"normals"} + voxels + Words{"-o", folder / "s.ply", "-o", folder / "s.om"})
          .exit_code,
      0);
  const Words geodesic = {"geodesic", "--source", "4,4,4", "-o", folder / "d.ply"};
  const auto report = report_of(geodesic + voxels);
  EXPECT_GT(report["surface"]["nonmanifold_edges"], 500);
  const PolygonMesh expected = read_mesh(folder / "d.ply");
  for (const char* file : {"s.ply", "s.om"}) {
    const auto polygons = report_of(geodesic + Words{folder / file});
    for (const char* count : {"vertices", "edges", "nonmanifold_edges", "euler", "components"}) {
      EXPECT_EQ(polygons["surface"][count], report["surface"][count]) << count;
    }
    const PolygonMesh found = read_mesh(folder / "d.ply");
    EXPECT_EQ(found.positions, expected.positions);
    const auto distance = [](const PolygonMesh& mesh) -> const std::vector<double>& {
      return std::find_if(mesh.fields.begin(), mesh.fields.end(),
                          [](const MeshField& f) { return f.name == "distance"; })
          ->values;
    };
    for (Index v = 0; v < found.positions.cols(); ++v) {
      const auto at = static_cast<std::size_t>(v);
      ASSERT_NEAR(distance(found)[at], distance(expected)[at], 1e-8) << file;
    }
  }
}

TEST(MeshInput, TheNormalsOfTheFileDecideTheCalculus) {
  const Folder folder;
  const Words function = {"--function", "x"};
  write_file(folder / "cube.obj", kCube);
  ASSERT_EQ(run_dsc({"normals", folder / "cube.obj", "-o", folder / "n.ply"}).exit_code, 0);
  EXPECT_EQ(report_of(Words{"gradient", folder / "cube.obj"} + function)["calculus"]["kind"],
            "naive");
  EXPECT_EQ(report_of(Words{"gradient", folder / "n.ply"} + function)["calculus"]["kind"],
            "projected");
  EXPECT_EQ(report_of(Words{"gradient", folder / "n.ply", "--calculus", "naive"} +
                      function)["calculus"]["kind"],
            "naive");
  expect_refused(
      run_dsc(Words{"gradient", folder / "cube.obj", "--calculus", "projected"} + function), 3,
      {"no normals", "--calculus naive"});
}

TEST(MeshInput, TheGradientOfALinearFunctionIsExactOnAnyPolygons) {
  const Folder folder;
  // A square of one triangle, one quad and one pentagon, in a slanted plane z = x.
  write_file(folder / "plane.off",
             "OFF\n7 3 0\n0 0 0\n2 0 2\n2 2 2\n0 2 0\n1 0 1\n0 1 0\n2 1 2\n"
             "3 0 4 5\n4 4 1 6 5\n4 5 6 2 3\n");
  const auto report =
      report_of({"gradient", folder / "plane.off", "--function", "x+3*y", "-o", folder / "g.ply"});
  // Of x along (1,0,1)/sqrt(2): (1/2, 0, 1/2).
  const PolygonMesh mesh = read_mesh(folder / "g.ply");
  ASSERT_EQ(mesh.fields.size(), 1U);
  const std::vector<double>& g = mesh.fields[0].values;
  for (std::size_t f = 0; f < 3; ++f) {
    EXPECT_NEAR(g[3 * f], 0.5, 1e-13);
    EXPECT_NEAR(g[3 * f + 1], 3, 1e-13);
    EXPECT_NEAR(g[3 * f + 2], 0.5, 1e-13);
  }
}

TEST(MeshInput, VerticesWithoutFacesAreLeftOutByWarning) {
  const Folder folder;
  write_file(folder / "a.obj", "v 7 7 7\n" + std::string("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n") +
                                   "f 2 3 4\nf 2 4 5\n");
  const auto report =
      report_of({"geodesic", folder / "a.obj", "--source", "0,0,0", "-o", folder / "d.ply"});
  ASSERT_EQ(report["warnings"].size(), 1U);
  EXPECT_NE(report["warnings"][0].get<std::string>().find("1 of its vertices"), std::string::npos);
  EXPECT_EQ(read_mesh(folder / "d.ply").positions.cols(), 4);
  expect_refused(run_dsc({"geodesic", folder / "a.obj", "--source-vertex", "1"}), 3,
                 {"--source x,y,z"});
}

TEST(MeshInput, WhatOnlyVoxelsHaveIsRefused) {
  const Folder folder;
  write_file(folder / "cube.obj", kCube);
  const std::string cube = folder / "cube.obj";
  expect_refused(run_dsc({"normals", cube, "--estimator", "ii"}), 2, {"voxels"});
  expect_refused(run_dsc({"normals", cube, "--radius", "2"}), 2, {"voxels"});
  expect_refused(run_dsc({"info", cube, "--gridstep", "2"}), 2, {"--gridstep"});
  expect_refused(run_dsc({"info", cube, "--label", "2"}), 2, {"--label"});
  expect_refused(run_dsc({"info", cube, "--border", "open"}), 2, {"--border"});
  expect_refused(run_dsc({"geodesic", cube, "--source", "0,0,0", "--estimator", "trivial"}), 2,
                 {"naive"});
}

TEST(MeshInput, ABrokenFileIsRefusedWithItsLine) {
  const Folder folder;
  write_file(folder / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 nan\nf 1 2 3\n");
  expect_refused(run_dsc({"info", folder / "a.obj"}), 3, {"a.obj", "line 3", "not a number"});
  write_file(folder / "b.obj", "v 0 0 0\n");
  expect_refused(run_dsc({"info", folder / "b.obj"}), 3, {"b.obj", "no face"});
  write_file(folder / "c.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n");
  expect_refused(run_dsc({"normals", folder / "c.off"}), 3, {"face 0", "no area"});
}

}  // namespace
}  // namespace dsc::test
