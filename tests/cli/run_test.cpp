// What the program computes, against known truths, and what it writes.
#include "tests/cli/program.h"

#include "tests/io/result_parsers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

namespace dsc::test {
namespace {

const Words kSphere = {"shape:sphere", "--gridstep", "0.1"};
const Words kSource = {"--source", "0.3,0.5,0.81"};

/// No value of a report is null: all numbers were finite.
void expect_no_null(const nlohmann::json& json, const std::string& where = "report") {
  EXPECT_FALSE(json.is_null()) << where;
  if (json.is_structured()) {
    for (const auto& [key, value] : json.items()) expect_no_null(value, where + "." + key);
  }
}

TEST(Info, TheSphereIsOneClosedSurfaceOfEulerNumberTwo) {
  const Outcome outcome = run_dsc(Words{"info"} + kSphere);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(outcome.out.find("1 component, Euler number 2"), std::string::npos) << outcome.out;
  const auto report = report_of(Words{"info"} + kSphere);
  EXPECT_EQ(report["surface"]["components"], 1);
  EXPECT_EQ(report["surface"]["euler"], 2);
  EXPECT_EQ(report["surface"]["boundary_edges"], 0);
  EXPECT_EQ(report["surface"]["nonmanifold_edges"], 0);
  EXPECT_EQ(report["surface"]["pinched_vertices"], 0);
  // The voxels inside are the lattice points of the open ball of radius 10.
  int inside = 0;
  for (int x = -10; x <= 10; ++x) {
    for (int y = -10; y <= 10; ++y) {
      for (int z = -10; z <= 10; ++z) inside += x * x + y * y + z * z < 100 ? 1 : 0;
    }
  }
  EXPECT_EQ(report["input"]["voxels_inside"], inside);
}

TEST(Info, ATorusHasEulerNumberZero) {
  const auto report = report_of({"info", "shape:torus,R=1,r=0.4", "--gridstep", "0.05"});
  EXPECT_EQ(report["surface"]["euler"], 0);
  EXPECT_EQ(report["surface"]["components"], 1);
}

TEST(Info, ACutPlaneIsADiscWithABoundary) {
  const auto report = report_of({"info", "shape:plane,nx=1,ny=2,nz=3,size=2", "--gridstep", "0.1"});
  EXPECT_EQ(report["surface"]["components"], 1);
  EXPECT_EQ(report["surface"]["euler"], 1);
  EXPECT_GT(report["surface"]["boundary_edges"], 0);
}

TEST(Report, HoldsEveryKeyThatIsPromised) {
  const auto report = report_of(Words{"geodesic"} + kSphere + kSource);
  for (const char* key : {"vertices", "faces", "components", "boundary_edges", "nonmanifold_edges",
                          "pinched_vertices", "euler"}) {
    EXPECT_TRUE(report["surface"][key].is_number_integer()) << key;
  }
  EXPECT_EQ(report["normals"]["estimator"], "ii");
  EXPECT_NEAR(report["normals"]["radius"], 3 * std::sqrt(0.1), 1e-12);
  EXPECT_TRUE(report["calculus"]["clamped_faces"].is_number_integer());
  double sum = 0;
  for (const char* key : {"read", "extract", "normals", "smooth", "assemble", "factorize", "solve",
                          "check", "write"}) {
    EXPECT_GE(report["timings_s"][key], 0.) << key;
    sum += report["timings_s"][key].get<double>();
  }
  EXPECT_LE(sum, 1.001 * report["timings_s"]["total"].get<double>());
  EXPECT_GT(report["peak_memory_bytes"], 1 << 20);
  for (const char* key : {"min", "max", "mean"}) EXPECT_TRUE(report["result"][key].is_number());
  for (const char* key : {"mean", "max", "l2"}) EXPECT_TRUE(report["error"][key].is_number());
  EXPECT_TRUE(report["warnings"].is_array());
  expect_no_null(report);
}

TEST(Report, TellsHowDistancesCameAbout) {
  const auto heat =
      report_of(Words{"geodesic"} + kSphere + kSource + Words{"--time", "0.04"})["heat"];
  EXPECT_DOUBLE_EQ(heat["time"], 0.04);
  EXPECT_EQ(heat["time_raised"], false);
  EXPECT_EQ(heat["method"], "bands");
  EXPECT_EQ(heat["components_without_source"], 0);
  for (const char* key : {"flat_faces", "negative_faces", "raised_vertices"}) {
    EXPECT_GE(heat[key].get<long>(), 0) << key;
  }
  EXPECT_LE(heat["lowest_value"], 0.);
  EXPECT_LE(heat["heat_residual"], 1e-3);
  EXPECT_LE(heat["poisson_residual"], 1e-5);
}

TEST(Geodesic, ReachesTheExactDistanceOnTheSphereWhereTheNaiveCalculusDoesNot) {
  const auto projected = report_of(Words{"geodesic"} + kSphere + kSource);
  EXPECT_LE(projected["error"]["mean"], 0.018);
  EXPECT_LE(projected["error"]["max"], 0.038);
  EXPECT_LE(projected["error"]["mean"], projected["error"]["l2"]);
  EXPECT_LE(projected["error"]["l2"], projected["error"]["max"]);
  EXPECT_EQ(projected["result"]["min"], 0);
  EXPECT_NEAR(projected["result"]["max"], std::numbers::pi, 0.06);
  const auto naive = report_of(Words{"geodesic", "--calculus", "naive"} + kSphere + kSource);
  EXPECT_GT(naive["error"]["mean"], 0.2);
  EXPECT_FALSE(naive.contains("normals"));
}

TEST(Geodesic, SeveralSourcesGiveTheDistanceToTheNearest) {
  const Folder folder;
  const auto report = report_of(
      Words{"geodesic", "--source", "0,0,1", "--source", "0,0,-1", "-o", folder / "d.csv"} +
      kSphere);
  EXPECT_EQ(report["source_vertices"].size(), 2U);
  EXPECT_LE(report["error"]["mean"], 0.03);
  // The heat method rounds off the ridge between two sources over about a gridstep.
  EXPECT_NEAR(report["result"]["max"], std::numbers::pi / 2, 0.15);
  int zeros = 0;
  for (const auto& row : read_csv(folder / "d.csv").rows) zeros += row[3] == 0 ? 1 : 0;
  EXPECT_EQ(zeros, 2);
}

TEST(Geodesic, ASourceVertexIsTheVertexOfThatNumber) {
  const Folder folder;
  report_of(Words{"geodesic", "--source-vertex", "77", "-o", folder / "d.csv"} + kSphere);
  EXPECT_EQ(read_csv(folder / "d.csv").rows.at(77).at(3), 0);
}

TEST(Geodesic, AComponentWithoutASourceIsInfinitelyFar) {
  const Folder folder;
  // Two balls: the second one, around (4, 0, 0), has no source.
  const std::string shape =
      "shape:expr:min(x^2+y^2+z^2,(x-4)^2+y^2+z^2)-1;box=-1.5,-1.5,-1.5,5.5,1.5,1.5";
  const Outcome outcome = run_dsc({"geodesic", shape, "--gridstep", "0.2", "--source", "0,0,1",
                                   "-o", folder / "d.csv", "--report", folder / "r.json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("warning"), std::string::npos);
  const auto report = read_json(folder / "r.json");
  int infinite = 0;
  for (const auto& row : read_csv(folder / "d.csv").rows) {
    EXPECT_EQ(std::isinf(row[3]), row[0] > 2);
    infinite += std::isinf(row[3]) ? 1 : 0;
  }
  EXPECT_GT(infinite, 0);
  EXPECT_EQ(report["result"]["infinite"], infinite);
  expect_no_null(report);
}

TEST(Normals, OfTheSphereApproachTheExactOnes) {
  const auto ii = report_of(Words{"normals"} + kSphere);
  const auto trivial = report_of(Words{"normals", "--estimator", "trivial"} + kSphere);
  EXPECT_LT(ii["error"]["mean"], 0.06);  // radians
  EXPECT_LT(ii["error"]["mean"], trivial["error"]["mean"]);
  const auto exact = report_of(Words{"normals", "--estimator", "analytic"} + kSphere);
  EXPECT_FALSE(exact.contains("error"));
}

TEST(Normals, AreUnitVectorsThatPointOutwards) {
  const Folder folder;
  report_of(Words{"normals", "-o", folder / "n.ply", "-o", folder / "n.csv"} + kSphere);
  const PlyFile ply = read_ply(folder / "n.ply");
  const auto u = ply.face_columns({"nx", "ny", "nz"});
  const auto csv = read_csv(folder / "n.csv");
  ASSERT_EQ(u.size(), 3 * csv.rows.size());
  for (std::size_t f = 0; f < csv.rows.size(); ++f) {
    double length = 0, outwards = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(u[3 * f + i], csv.rows[f][3 + i]);
      length += u[3 * f + i] * u[3 * f + i];
      outwards += u[3 * f + i] * csv.rows[f][i];
    }
    EXPECT_NEAR(length, 1, 1e-12);
    EXPECT_GT(outwards, 0.8);
  }
}

TEST(Gradient, OfACoordinateOnTheSphereConverges) {
  double previous = 1;
  for (const char* h : {"0.2", "0.1", "0.05"}) {
    const auto report = report_of({"gradient", "shape:sphere", "--gridstep", h, "--function", "x"});
    EXPECT_LT(report["error"]["l2"], 0.9 * previous) << h;
    previous = report["error"]["l2"];
  }
  EXPECT_LT(previous, 0.1);
}

TEST(Gradient, IsTangentToTheNormalsOfTheCalculus) {
  const Folder folder;
  report_of(Words{"gradient", "--function", "x*y+z", "-o", folder / "g.ply"} + kSphere);
  report_of(Words{"normals", "-o", folder / "n.ply"} + kSphere);
  const auto g = read_ply(folder / "g.ply").face_columns({"gx", "gy", "gz"});
  const auto u = read_ply(folder / "n.ply").face_columns({"nx", "ny", "nz"});
  ASSERT_EQ(g.size(), u.size());
  for (std::size_t f = 0; f < g.size(); f += 3) {
    EXPECT_NEAR(g[f] * u[f] + g[f + 1] * u[f + 1] + g[f + 2] * u[f + 2], 0, 1e-9);
  }
}

TEST(Diffuse, KeepsAUnitOfHeatAndEvensItOut) {
  // After a long time the heat is one over the area of the sphere everywhere.
  const auto report = report_of(Words{"diffuse", "--time", "1e4"} + kSphere + kSource);
  EXPECT_NEAR(report["result"]["max"], 1 / (4 * std::numbers::pi), 0.01);
  EXPECT_NEAR(report["result"]["min"], 1 / (4 * std::numbers::pi), 0.01);
}

TEST(Spectrum, OfTheSphereIsThatOfTheHarmonics) {
  const Folder folder;
  const auto report = report_of(Words{"spectrum", "-k", "9", "-o", folder / "modes.csv"} + kSphere);
  const auto values = report["spectrum"]["eigenvalues"];
  ASSERT_EQ(values.size(), 9U);
  const double exact[] = {0, 2, 2, 2, 6, 6, 6, 6, 6};
  for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(values[k], exact[k], 0.03 * exact[k] + 1e-9) << k;
  EXPECT_LT(report["error"]["max"], 0.03 * 6);
}

TEST(Stabilisation, EachKindFindsTheSpectrumAndTheDistancesOfTheSphere) {
  for (const std::string kind : {"de-goes", "mercat", "elements", "refinement"}) {
    const Words stabilised = Words{"--stabilisation", kind} + kSphere;
    const auto spectrum = report_of(Words{"spectrum", "-k", "9"} + stabilised);
    EXPECT_EQ(spectrum["calculus"]["stabilisation"], kind);
    EXPECT_LT(spectrum["error"]["max"], 0.03 * 6) << kind;
    const auto& found = spectrum["spectrum"];
    EXPECT_EQ(found.contains("checkerboards_left_out"), kind == "mercat");
    if (kind == "mercat") {
      EXPECT_GT(found["checkerboards_left_out"], 0);
    }
    const auto distance = report_of(Words{"geodesic"} + stabilised + kSource);
    EXPECT_LT(distance["error"]["mean"], 0.018) << kind;
  }
}

TEST(Stabilisation, PoissonHasAFreeConstantForEachParityWithoutIt) {
  const Folder folder;
  const auto report = report_of(
      Words{"poisson", "--rhs", "-2*x", "--stabilisation", "mercat", "-o", folder / "u.csv"} +
      kSphere);
  EXPECT_EQ(report["poisson"]["free_components"], 2);
  for (const auto& row : read_csv(folder / "u.csv").rows) {
    const double length = std::sqrt(row[0] * row[0] + row[1] * row[1] + row[2] * row[2]);
    EXPECT_NEAR(row[3], row[0] / length, 0.02);
  }
}

TEST(Surface, IsWrittenWithSharedVertices) {
  const Folder folder;
  const auto report =
      report_of(Words{"surface", "-o", folder / "s.ply", "-o", folder / "s.vtp"} + kSphere);
  const PlyFile ply = read_ply(folder / "s.ply");
  EXPECT_EQ(report["surface"]["faces"], ply.faces.size());
  EXPECT_EQ(report["surface"]["vertices"], ply.vertices.size());
  EXPECT_EQ(report["outputs"].size(), 2U);
  std::set<std::vector<double>> positions(ply.vertices.begin(), ply.vertices.end());
  EXPECT_EQ(positions.size(), ply.vertices.size()) << "a vertex was written twice";
  // V - E + F with the edges counted here.
  std::set<std::pair<int, int>> edges;
  for (const auto& face : ply.faces) {
    for (std::size_t c = 0; c < 4; ++c) edges.insert(std::minmax(face[c], face[(c + 1) % 4]));
  }
  EXPECT_EQ(
      static_cast<long>(ply.vertices.size() + ply.faces.size()) - static_cast<long>(edges.size()),
      2);
  EXPECT_EQ(read_vtp(folder / "s.vtp").polys, static_cast<Index>(ply.faces.size()));
}

TEST(Results, AreTheSameBytesForAnyThreadCount) {
  const Folder folder;
  // 20 000 faces and vertices: several chunks of every loop but the widest.
  const Words sphere = {"shape:sphere", "--gridstep", "0.03"};
  for (const Words& command :
       {Words{"normals"}, Words{"normals", "--estimator", "trivial"},
        Words{"normals", "--estimator", "analytic"}, Words{"gradient", "--function", "sin(3*x)+y"},
        Words{"laplacian", "--function", "x*y", "--diffuse", "0.01"},
        Words{"poisson", "--rhs", "x*y"}, Words{"curvature"},
        Words{"diffuse", "--time", "0.1"} + kSource, Words{"geodesic"} + kSource}) {
    std::string reference;
    for (const char* threads : {"1", "2", "4", "8"}) {
      const Outcome outcome =
          run_dsc(command + sphere + Words{"--threads", threads, "-o", folder / "r.ply"});
      ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
      const std::string bytes = read_file(folder / "r.ply");
      if (reference.empty()) reference = bytes;
      EXPECT_TRUE(bytes == reference) << command[0] << " with " << threads << " threads";
    }
  }
}

TEST(Anisotropy, TheSphereKeepsItsDistancesOnStretchedVoxels) {
  const auto report =
      report_of(Words{"geodesic", "shape:sphere", "--gridstep", "0.05,0.05,0.1"} + kSource);
  EXPECT_LE(report["error"]["mean"], 0.04);
}

TEST(Info, ARawFileIsReadAsItsOptionsSay) {
  const Folder folder;
  std::string bytes(3, '#');  // a header
  for (const int v : {0, 300, 400, 0, 301, 0}) {
    bytes += static_cast<char>(v >> 8);
    bytes += static_cast<char>(v & 255);
  }
  write_file(folder / "v.dat", bytes);
  const Words raw = {"info", folder / "v.dat", "--size", "3,2,1",       "--type", "i16", "--endian",
                     "big",  "--offset",       "3",      "--threshold", "300,301"};
  const auto report = report_of(raw);
  EXPECT_EQ(report["input"]["size"], (std::vector<int>{3, 2, 1}));
  EXPECT_EQ(report["input"]["voxels_inside"], 2);
  write_file(folder / "v.dat", bytes + "x");
  const Outcome outcome = run_dsc(raw);
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("12 bytes, the file holds 13"), std::string::npos) << outcome.err;
}

/// spot-64.vol through every command.
class RealVoxels : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    spot_ = test_data(GetParam());
    if (spot_.empty()) GTEST_SKIP() << "DSC_TEST_DATA names no folder with " << GetParam();
  }
  bool is(const char* name) const { return name == std::string(GetParam()); }

  /// Runs `command`, and returns the report of a closed surface in one piece.
  nlohmann::json expect_runs(const Words& command) const {
    const auto report = report_of(command + Words{spot_});
    expect_no_null(report);
    EXPECT_EQ(report["surface"]["components"], 1) << command[0];
    EXPECT_EQ(report["surface"]["boundary_edges"], 0) << command[0];
    return report;
  }
  std::string spot_;
};

TEST_P(RealVoxels, GoThroughEveryCommand) {
  const Folder folder;
  const Words source = {"--source-vertex", "0"};
  expect_runs({"info"});
  expect_runs(Words{"geodesic", "-o", folder / "d.ply"} + source);
  const auto distance = read_ply(folder / "d.ply").vertex_columns({"distance"});
  EXPECT_EQ(distance.at(0), 0);
  for (const double d : distance) EXPECT_TRUE(std::isfinite(d) && d >= 0);
  if (is("spot-512.vol")) return;  // the time that the others would take shows nothing new

  for (const Words& command :
       {Words{"surface", "-o", folder / "s.ply"}, Words{"normals", "-o", folder / "n.vtp"},
        Words{"gradient", "--function", "x+y*z", "-o", folder / "g.vtp"},
        Words{"diffuse", "--time", "9", "-o", folder / "w.csv"} + source,
        Words{"curvature", "-o", folder / "k.vtp"}}) {
    expect_runs(command);
  }
  if (is("spot-256.vol")) return;

  for (const Words& command :
       {Words{"normals", "--estimator", "trivial", "-o", folder / "t.csv"},
        Words{"poisson", "--rhs", "x", "-o", folder / "p.vtp"},
        Words{"laplacian", "--function", "x+y*z", "--diffuse", "9", "-o", folder / "l.om"},
        Words{"geodesic", "--adjacency", "exterior"} + source,
        Words{"geodesic", "--calculus", "naive"} + source}) {
    expect_runs(command);
  }
  if (is("spot-128.vol")) return;

  for (const Words& command :
       {Words{"curvature", "--estimator", "laplacian", "--diffuse", "9", "-o", folder / "h.ply"},
        Words{"surface", "--regularise", "-o", folder / "r.off"},
        Words{"spectrum", "-k", "4", "-o", folder / "m.vtp"},
        Words{"geodesic", "--method", "direct"} + source}) {
    expect_runs(command);
  }
}

INSTANTIATE_TEST_SUITE_P(Spot, RealVoxels,
                         ::testing::Values("spot-64.vol", "spot-128.vol", "spot-256.vol",
                                           "spot-512.vol"));

}  // namespace
}  // namespace dsc::test
