// Label images through every command.
#include "libdsc/io/volume_writer.h"
#include "tests/cli/program.h"
#include "tests/io/result_parsers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

namespace dsc::test {
namespace {

using Pair = std::pair<double, double>;

/// A box of 12 x 12 x 8 voxels with a margin of one: label 3 at x < 6, elsewhere 7 at y < 6 and
/// 9 at the others. The three meet along the line x = 5.5, y = 5.5.
class ThreeLabels : public ::testing::Test {
 protected:
  ThreeLabels() : path_(folder_ / "labels.npy") {
    const Grid grid{{14, 14, 10}, {1, 1, 1}, Vec3::Zero()};
    std::vector<std::uint16_t> values(static_cast<std::size_t>(grid.voxels()), 0);
    for (Index z = 1; z < 9; ++z) {
      for (Index y = 1; y < 13; ++y) {
        for (Index x = 1; x < 13; ++x) {
          values[static_cast<std::size_t>(x + 14 * (y + 14 * z))] = x < 7 ? 3 : y < 7 ? 7 : 9;
        }
      }
    }
    write_volume(path_, grid, std::span<const std::uint16_t>(values));
  }

  nlohmann::json report_of(Words arguments) const {
    const std::string report = folder_ / "report.json";
    arguments.insert(arguments.end(), {path_, "--report", report});
    const Outcome outcome = run_dsc(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.exit_code == 0 ? read_json(report) : nlohmann::json();
  }

  Folder folder_;
  std::string path_;
};

/// The faces of every pair of labels, by area: 12 x 12 x 8 cut at the middle.
const std::map<Pair, int> kFaces = {{{3, 0}, 6 * 12 * 2 + 12 * 8 + 2 * 6 * 8},
                                    {{7, 0}, 6 * 6 * 2 + 2 * 6 * 8},
                                    {{9, 0}, 6 * 6 * 2 + 2 * 6 * 8},
                                    {{3, 7}, 6 * 8},
                                    {{3, 9}, 6 * 8},
                                    {{7, 9}, 6 * 8}};

TEST_F(ThreeLabels, EveryInterfaceIsWrittenWithItsTwoLabels) {
  const auto report =
      report_of({"surface", "--labels", "all", "-o", folder_ / "s.ply", "-o", folder_ / "s.vtp"});
  EXPECT_EQ(report["input"]["labels"], 3);
  EXPECT_EQ(report["input"]["voxels_inside"], 12 * 12 * 8);
  // The line inside, and where an interface meets the outside: around 3|7 and 3|9 together, and
  // around 7|9 without the side at the line.
  EXPECT_EQ(report["surface"]["junction_edges"], 8 + 2 * (12 + 8) + (2 * 6 + 8));
  EXPECT_EQ(report["surface"]["nonmanifold_edges"], report["surface"]["junction_edges"]);
  EXPECT_EQ(report["surface"]["components"], 1);
  const PlyFile ply = read_ply(folder_ / "s.ply");
  const auto labels = ply.face_columns({"label_inner", "label_outer"});
  std::map<Pair, int> faces;
  for (std::size_t f = 0; f < ply.faces.size(); ++f) ++faces[{labels[2 * f], labels[2 * f + 1]}];
  EXPECT_EQ(faces, kFaces);
  EXPECT_EQ(read_vtp(folder_ / "s.vtp").doubles("CellData", "label_outer", 1).size(),
            ply.faces.size());
  // A vertex of the junction is one vertex.
  const std::set<std::vector<double>> positions(ply.vertices.begin(), ply.vertices.end());
  EXPECT_EQ(positions.size(), ply.vertices.size());
}

TEST_F(ThreeLabels, OneInterfaceIsTheFacesBetweenItsLabels) {
  for (const std::string pair : {"3,7", "7,3"}) {
    const auto report =
        report_of({"surface", "--between", pair, "-o", folder_ / "s.csv", "-o", folder_ / "s.ply"});
    EXPECT_EQ(report["surface"]["faces"], 48);
    EXPECT_EQ(report["surface"]["junction_edges"], 0);
    EXPECT_EQ(report["surface"]["euler"], 1);
    EXPECT_EQ(report["surface"]["boundary_edges"], 2 * (6 + 8));
    // It faces from 3 to 7, towards +x, whichever was named first.
    const CsvFile csv = read_csv(folder_ / "s.csv");
    EXPECT_EQ(csv.header, (Words{"x", "y", "z", "label_inner", "label_outer"}));
    for (const auto& row : csv.rows) EXPECT_EQ(row, (std::vector{6.5, row[1], row[2], 3., 7.}));
  }
  EXPECT_EQ(report_of({"info", "--between", "3,7", "--between", "7,9"})["surface"]["faces"], 96);
  const Outcome none = run_dsc({"info", path_, "--between", "3,4"});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_NE(none.err.find("labels"), std::string::npos) << none.err;
}

TEST_F(ThreeLabels, NormalsOfAFlatInterfaceAreItsOwnUpToTheJunction) {
  const auto report =
      report_of({"normals", "--labels", "all", "--radius", "2.5", "-o", folder_ / "n.csv"});
  EXPECT_GT(report["normals"]["third_label_faces"], 0);
  EXPECT_LT(report["normals"]["third_label_faces"], report["surface"]["faces"]);
  const CsvFile csv = read_csv(folder_ / "n.csv");
  int inner = 0;
  for (const auto& row : csv.rows) {
    const std::map<std::string, double> face = [&] {
      std::map<std::string, double> result;
      for (std::size_t i = 0; i < row.size(); ++i) result[csv.header[i]] = row[i];
      return result;
    }();
    if (face.at("label_inner") != 3 || face.at("label_outer") != 7) continue;
    // Balls that stay within 3 and 7 and are cut by their interface alone.
    if (face.at("y") > 4 || face.at("y") < 3 || std::abs(face.at("z") - 4.5) > 1) continue;
    EXPECT_NEAR(face.at("nx"), 1, 1e-12);
    ++inner;
  }
  EXPECT_GT(inner, 0);
  const auto binary = report_of({"normals"});
  EXPECT_FALSE(binary["normals"].contains("third_label_faces"));
}

TEST_F(ThreeLabels, DistancesCrossTheJunction) {
  // From one end of the interface 3|9 to the other of 3|7: a straight line across the junction.
  report_of({"geodesic", "--labels", "all", "--source", "6.5,12.5,4.5", "--estimator", "trivial",
             "-o", folder_ / "d.ply"});
  const PlyFile ply = read_ply(folder_ / "d.ply");
  const auto distance = ply.vertex_columns({"distance"});
  int on_interface = 0;
  for (std::size_t v = 0; v < distance.size(); ++v) {
    EXPECT_TRUE(std::isfinite(distance[v]) && distance[v] >= 0) << v;
    const auto& p = ply.vertices[v];
    if (p[0] != 6.5 || p[2] != 4.5) continue;
    EXPECT_NEAR(distance[v], 12.5 - p[1], 1.) << p[1];
    ++on_interface;
  }
  EXPECT_EQ(on_interface, 13);
}

TEST_F(ThreeLabels, GoThroughEveryCommand) {
  const std::vector<Words> commands = {
      {"info"},
      {"surface", "-o", folder_ / "s.ply"},
      {"normals", "-o", folder_ / "n.vtp"},
      {"gradient", "--function", "x+y*z", "-o", folder_ / "g.vtp"},
      {"diffuse", "--time", "9", "--source-vertex", "0", "-o", folder_ / "w.ply"},
      {"laplacian", "--function", "x+y*z", "-o", folder_ / "l.vtp"},
      {"poisson", "--rhs", "x", "-o", folder_ / "u.vtp"},
      {"spectrum", "-k", "3", "-o", folder_ / "e.vtp"},
      {"geodesic", "--source-vertex", "0", "-o", folder_ / "d.vtp"}};
  for (Words command : commands) {
    command.insert(command.end(), {"--labels", "all"});
    const auto report = report_of(command);
    EXPECT_EQ(report["surface"]["components"], 1) << command[0];
    EXPECT_EQ(report["surface"]["boundary_edges"], 0) << command[0];
  }
}

TEST_F(ThreeLabels, HaveALaplacianAcrossTheJunction) {
  // On surfels as they are y is linear on each face: its weak Laplacian vanishes wherever the
  // surface goes straight on, across the line where the three meet as well.
  report_of({"laplacian", "--labels", "all", "--calculus", "naive", "--function", "y", "-o",
             folder_ / "l.ply"});
  const PlyFile ply = read_ply(folder_ / "l.ply");
  const auto laplacian = ply.vertex_columns({"laplacian"});
  int inside = 0, corner = 0;
  for (std::size_t v = 0; v < laplacian.size(); ++v) {
    const auto& p = ply.vertices[v];
    if (p[2] == 0.5 || p[2] == 8.5) continue;
    if (p[0] == 6.5 && p[1] > 0.5 && p[1] < 12.5) {
      EXPECT_NEAR(laplacian[v], 0, 1e-12) << p[1];
      ++inside;
    }
    corner += std::abs(laplacian[v]) > 0.1 ? 1 : 0;  // at the ends of the sheets along y
  }
  EXPECT_EQ(inside, 11 * 7);
  EXPECT_GT(corner, 0);
}

TEST_F(ThreeLabels, PoissonAndSpectrumSeeOneSurface) {
  // One component, so one constant; the mean is what has to be removed of a constant.
  const auto poisson = report_of({"poisson", "--labels", "all", "--rhs", "3+y"});
  EXPECT_EQ(poisson["poisson"]["free_components"], 1);
  const auto whole = report_of({"poisson", "--labels", "all", "--rhs", "3"});
  EXPECT_NEAR(whole["poisson"]["removed_mean"], 3, 1e-12);
  EXPECT_NEAR(whole["result"]["max"], 0, 1e-9);
  const auto spectrum = report_of({"spectrum", "--labels", "all", "-k", "4"});
  const auto values = spectrum["spectrum"]["eigenvalues"].get<std::vector<double>>();
  EXPECT_NEAR(values[0], 0, 1e-9);
  EXPECT_GT(values[1], 1e-3);
}

TEST(Labels, ANegativeValueIsRefusedWithItsVoxel) {
  const Folder folder;
  const std::int16_t values[] = {0, 3, -5, 2};
  write_volume(folder / "v.npy", Grid{{2, 2, 1}, {1, 1, 1}, Vec3::Zero()},
               std::span<const std::int16_t>(values));
  const Outcome outcome = run_dsc({"info", folder / "v.npy", "--labels", "all"});
  EXPECT_EQ(outcome.exit_code, 3);
  for (const char* part : {"v.npy", "(0, 1, 0)", "-5"}) {
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace dsc::test
