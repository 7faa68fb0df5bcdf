// Errors against known answers: where there are any, and that there are none elsewhere.
#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dsc::test {
namespace {

Words plane(const std::string& h, const std::string& size = "4") {
  return {"shape:plane,nx=1,ny=2,nz=3,size=" + size, "--gridstep", h};
}
const std::string kHalfBall = "expr:x^2+y^2+z^2-1;box=-1.2,-1.2,0,1.2,1.2,1.2";
Words half_ball(const std::string& h, bool open) {
  return {"shape:" + kHalfBall + (open ? ";open" : ""), "--gridstep", h};
}

bool has_warning(const nlohmann::json& report, const std::string& part) {
  for (const auto& warning : report["warnings"]) {
    if (warning.get<std::string>().find(part) != std::string::npos) return true;
  }
  return false;
}

TEST(Truth, ThereIsNoneWhereABoxClosesTheSurface) {
  const std::vector<Words> commands = {
      {"normals"},   {"gradient", "--function", "x"}, {"laplacian", "--function", "x"},
      {"curvature"}, {"curvature", "--on", "vertex"}, {"geodesic", "--source", "0,0,0"}};
  for (const Words& command : commands) {
    const auto closed = report_of(command + plane("0.2") + Words{"--border", "closed"});
    EXPECT_FALSE(closed.contains("error")) << command[0];
    EXPECT_TRUE(has_warning(closed, "no error is given")) << command[0];
    const auto open = report_of(command + plane("0.2"));
    EXPECT_TRUE(open.contains("error")) << command[0];
    EXPECT_FALSE(has_warning(open, "no error is given")) << command[0];
  }
  // An expression that its box closes is no better.
  const auto closed = report_of(Words{"normals"} + half_ball("0.1", false));
  EXPECT_FALSE(closed.contains("error"));
  EXPECT_TRUE(has_warning(closed, "no error is given"));
  const auto open = report_of(Words{"normals"} + half_ball("0.1", true));
  EXPECT_LT(open["error"]["mean"], 0.06);
}

TEST(Truth, OfThePlaneIsReachedAndNaiveIsNot) {
  std::vector<double> distances, gradients;
  for (const char* h : {"0.2", "0.05"}) {
    const auto distance = report_of(Words{"geodesic", "--source", "0,0,0"} + plane(h));
    const auto gradient = report_of(Words{"gradient", "--function", "x-y"} + plane(h));
    distances.push_back(distance["error"]["mean"]);
    gradients.push_back(gradient["error"]["l2"]);
  }
  EXPECT_LT(distances[1], 0.5 * distances[0]);
  EXPECT_LT(distances[1], 0.02);
  EXPECT_LT(gradients[1], gradients[0]);
  EXPECT_LT(gradients[1], 0.02);
  const Words naive = {"--calculus", "naive"};
  const auto distance = report_of(Words{"geodesic", "--source", "0,0,0"} + naive + plane("0.05"));
  const auto gradient = report_of(Words{"gradient", "--function", "x-y"} + naive + plane("0.05"));
  EXPECT_GT(distance["error"]["mean"], 5 * distances[1]);
  EXPECT_GT(gradient["error"]["mean"], 0.3);
}

TEST(Truth, ThatIsNotKnownEverywhereIsLeftOutAndCounted) {
  for (const Words& command : {Words{"normals"}, Words{"gradient", "--function", "x"}}) {
    const auto report = report_of(command + Words{"shape:heart", "--gridstep", "0.1"});
    const long left_out = report["error"]["left_out"];
    EXPECT_GT(left_out, 0) << "the heart has a crease inside of it";
    EXPECT_LT(left_out, report["surface"]["faces"].get<long>() / 4);
    EXPECT_TRUE(has_warning(report, "left out of the error: " + std::to_string(left_out)));
    const auto sphere = report_of(command + Words{"shape:sphere", "--gridstep", "0.1"});
    EXPECT_EQ(sphere["error"]["left_out"], 0);
  }
}

TEST(Truth, ScalesWithTheFunctionAtAnySize) {
  const Words sphere = {"shape:sphere", "--gridstep", "0.1"};
  const auto unit = report_of(Words{"gradient", "--function", "x"} + sphere);
  for (const char* scale : {"1e200", "1e-200"}) {
    const double s = std::stod(scale);
    const auto scaled =
        report_of(Words{"gradient", "--function", std::string(scale) + "*x"} + sphere);
    for (const char* key : {"mean", "max", "l2"}) {
      EXPECT_NEAR(scaled["error"][key].get<double>() / s, unit["error"][key].get<double>(), 1e-8);
    }
    EXPECT_NEAR(scaled["result"]["mean"].get<double>() / s, unit["result"]["mean"].get<double>(),
                1e-8);
  }
  const Outcome outcome = run_dsc(Words{"gradient", "--function", "1.79e308*x"} + sphere);
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_NE(outcome.err.find("1.79e308*x"), std::string::npos) << outcome.err;
}

/// The stages leave nothing out, whatever takes the time.
TEST(Timings, OfTheStagesSumToTheTotal) {
  const Words goursat = {"shape:goursat", "--gridstep", "0.25"};
  for (const Words& command :
       {Words{"normals"}, Words{"gradient", "--function", "x*y"}, Words{"curvature"},
        Words{"laplacian", "--function", "x*y"}, Words{"poisson", "--rhs", "x"},
        Words{"diffuse", "--time", "0.1", "--source", "1,1,1"},
        Words{"geodesic", "--source", "1,1,1"}}) {
    auto timings = report_of(command + goursat)["timings_s"];
    const double total = timings["total"];
    double sum = 0;
    for (const auto& [stage, seconds] : timings.items()) {
      EXPECT_GE(seconds, 0.) << stage;
      if (stage != "total") sum += seconds.get<double>();
    }
    EXPECT_GT(sum, 0.9 * total) << command[0] << timings;
    EXPECT_LE(sum, 1.001 * total) << command[0] << timings;
  }
}

TEST(HalfSphere, MixedBoundaryIsNearerTheGreatCircleThanReflection) {
  // Along the half sphere no shortest path from its top leaves it: distances are great circles.
  const Folder folder;
  double errors[2] = {0, 0};
  int i = 0;
  for (const char* boundary : {"mixed", "neumann"}) {
    const auto report = report_of(
        Words{"geodesic", "--source", "0.7,0,0.7", "--boundary", boundary, "-o", folder / "d.csv"} +
        half_ball("0.05", true));
    EXPECT_GT(report["surface"]["boundary_edges"], 0);
    EXPECT_EQ(report["surface"]["euler"], 1);
    double sum = 0, count = 0;
    const std::string text = read_file(folder / "d.csv");
    double s[3] = {0, 0, 0};
    for (const bool find_source : {true, false}) {
      for (std::size_t at = text.find('\n') + 1; at < text.size(); at = text.find('\n', at) + 1) {
        double p[3], d = 0;
        ASSERT_EQ(std::sscanf(&text[at], "%lf,%lf,%lf,%lf", &p[0], &p[1], &p[2], &d), 4);
        if (find_source) {
          if (d == 0) std::copy(p, p + 3, s);
          continue;
        }
        const double dot = (p[0] * s[0] + p[1] * s[1] + p[2] * s[2]) /
                           std::sqrt((p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) *
                                     (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]));
        sum += std::abs(d - std::acos(std::min(1., dot)));
        ++count;
      }
    }
    errors[i++] = sum / count;
  }
  EXPECT_LT(errors[0], 0.03);
  EXPECT_LT(errors[0], errors[1]);
}

TEST(Adjacency, DecidesHowVoxelsThatShareAnEdgeAreJoined) {
  // Two voxels that touch along an edge: two pieces inside, or one.
  const Folder folder;
  write_file(folder / "v.vol", "X: 2\nY: 2\nZ: 1\nVersion: 2\n.\n" + std::string("\1\0\0\1", 4));
  const auto interior = report_of({"geodesic", folder / "v.vol", "--source", "0,0,0"});
  const auto exterior =
      report_of({"geodesic", folder / "v.vol", "--source", "0,0,0", "--adjacency", "exterior"});
  EXPECT_EQ(interior["surface"]["adjacency"], "interior");
  EXPECT_EQ(exterior["surface"]["adjacency"], "exterior");
  for (const auto& report : {interior, exterior}) {
    // The pointels glue both: 16 corners, 2 of them shared by both voxels.
    EXPECT_EQ(report["surface"]["faces"], 12);
    EXPECT_EQ(report["surface"]["vertices"], 14);
    EXPECT_EQ(report["surface"]["nonmanifold_edges"], 1);
    EXPECT_TRUE(report["result"]["max"].is_number());
    EXPECT_EQ(report["result"]["infinite"], 0);
  }
  EXPECT_EQ(interior["surface"]["pinched_vertices"], 2);
  EXPECT_EQ(exterior["surface"]["pinched_vertices"], 0);
}

TEST(Border, OpenLeavesTheSidesOfTheVolumeOut) {
  const Folder folder;
  // A column through a box of 3 x 3 x 4 voxels: it touches the border below and above.
  std::string voxels;
  for (int z = 0; z < 4; ++z) voxels += std::string("\0\0\0\0\1\0\0\0\0", 9);
  write_file(folder / "v.vol", "X: 3\nY: 3\nZ: 4\nVersion: 2\n.\n" + voxels);
  const auto closed = report_of({"info", folder / "v.vol"});
  EXPECT_EQ(closed["surface"]["faces"], 18);
  EXPECT_EQ(closed["surface"]["euler"], 2);
  EXPECT_EQ(closed["surface"]["boundary_edges"], 0);
  for (const Words& command : {Words{"info"}, Words{"gradient", "--function", "z"},
                               Words{"geodesic", "--source", "1,1,1"}}) {
    const auto open = report_of(command + Words{folder / "v.vol", "--border", "open"});
    EXPECT_EQ(open["surface"]["faces"], 16);
    EXPECT_EQ(open["surface"]["euler"], 0);
    EXPECT_EQ(open["surface"]["boundary_edges"], 8);
  }
}

}  // namespace
}  // namespace dsc::test
