// OpenVDB's volumes through the program.
#include "libdsc/io/volume_writer.h"
#include "tests/cli/program.h"
#include "tests/io/result_parsers.h"
#include "tests/support/vdb_files.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace dsc::test {
namespace {

// No voxel is on the sphere: around this centre all squares of distances are 256ths.
const Vec3 kCentre(2.3125, -7.25, 3.125);
const double kRadius = std::sqrt(60475.5 / 256);
constexpr double kSpacing = 0.1;

TEST(Vdb, InfoNamesTheGridAndWhatIsInside) {
  const Folder folder;
  Eigen::Matrix4d matrix = kSpacing * Eigen::Matrix4d::Identity();
  matrix(3, 3) = 1;
  write_vdb_ball(folder / "ball.vdb", "ball", kRadius, kCentre, matrix);
  const Outcome outcome = run_dsc({"info", folder / "ball.vdb", "--report", folder / "r.json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE((outcome.out + outcome.err).find("grid 'ball', a level set (value < 0)"),
            std::string::npos)
      << outcome.out << outcome.err;
  const auto report = read_json(folder / "r.json");
  EXPECT_EQ(report["input"]["grid"], "ball");
  EXPECT_EQ(report["input"]["class"], "level set");
  EXPECT_EQ(report["input"]["inside_where"], "value < 0");
  EXPECT_EQ(report["input"]["spacing"][0], kSpacing);
  EXPECT_EQ(report["surface"]["euler"], 2);
  Index inside = 0;
  for (int k = -40; k <= 40; ++k) {
    for (int j = -40; j <= 40; ++j) {
      for (int i = -40; i <= 40; ++i) inside += (Vec3(i, j, k) - kCentre).norm() < kRadius ? 1 : 0;
    }
  }
  EXPECT_EQ(report["input"]["voxels_inside"], inside);
  const Outcome chosen = run_dsc({"info", folder / "ball.vdb", "--threshold", "-1,1", "--grid",
                                  "ball", "--report", folder / "r.json"});
  ASSERT_EQ(chosen.exit_code, 0) << chosen.err;
  EXPECT_FALSE(read_json(folder / "r.json")["input"].contains("inside_where"));
}

/// The same ball as .vdb, turned in the world, and as a .npy of its inside with a margin.
TEST(Vdb, DistancesAreThoseOfTheSameVoxelsInTheWorld) {
  const Folder folder;
  const Mat3 turn = Eigen::AngleAxisd(0.5, Vec3(1, -2, 2).normalized()).toRotationMatrix();
  const Vec3 origin(-20, 100, 7);
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = kSpacing * turn;
  matrix.topRightCorner<3, 1>() = origin;
  write_vdb_ball(folder / "ball.vdb", "ball", kRadius, kCentre, matrix);
  constexpr Index n = 49;
  const Vec3 first(-22, -31, -21);
  std::vector<std::uint8_t> values;
  for (Index z = 0; z < n; ++z) {
    for (Index y = 0; y < n; ++y) {
      for (Index x = 0; x < n; ++x) {
        values.push_back((first + Vec3(x, y, z) - kCentre).norm() < kRadius ? 1 : 0);
      }
    }
  }
  write_volume(folder / "ball.npy", Grid{{n, n, n}, {1, 1, 1}, Vec3::Zero()},
               std::span<const std::uint8_t>(values));
  const auto text = [](const Vec3& p) {
    return std::to_string(p[0]) + "," + std::to_string(p[1]) + "," + std::to_string(p[2]);
  };
  const Vec3 pole = kCentre + Vec3(0, 0, kRadius);  // in voxels
  const auto run = [&](const std::string& name, const Vec3& source, const Words& more) {
    // No voxel is at this distance of another, where rounding would decide.
    const Words words{"geodesic", folder / name, "--source", text(source),
                      "--radius", "0.57",        "-o",       folder / "out.ply"};
    const Outcome outcome = run_dsc(words + more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return read_ply(folder / "out.ply");
  };
  const PlyFile here = run("ball.npy", kSpacing * (pole - first), {"--gridstep", "0.1"});
  const PlyFile there = run("ball.vdb", kSpacing * turn * pole + origin, {});
  ASSERT_EQ(here.vertices.size(), there.vertices.size());
  double worst = 0;
  for (std::size_t v = 0; v < here.vertices.size(); ++v) {
    const auto& p = here.vertices[v];
    const auto& q = there.vertices[v];
    EXPECT_NEAR(p[3], q[3], 1e-7) << v;  // the residual of the heat is some 1e-8
    const Vec3 place = Vec3(p[0], p[1], p[2]) + kSpacing * first;
    EXPECT_LT((turn * place + origin - Vec3(q[0], q[1], q[2])).norm(), 1e-9);
    const Vec3 out = (place - kSpacing * kCentre).normalized();
    const double exact = kSpacing * kRadius * std::acos(std::clamp(out[2], -1., 1.));
    worst = std::max(worst, std::abs(q[3] - exact));
  }
  EXPECT_LT(worst, 2 * kSpacing) << "the great circle's length, to two voxels";
}

TEST(Vdb, GridsAreChosenByAnOption) {
  const Folder folder;
  const std::string path = folder / "v.vdb";
  const VdbGrid one{.name = "one", .fills = {{{0, 0, 0}, {4, 4, 4}, 1}}};
  VdbGrid two = one;
  two.name = "two";
  two.fills[0].last = {9, 9, 9};
  write_vdb(path, {one, two});
  const Outcome ambiguous = run_dsc({"info", path});
  EXPECT_EQ(ambiguous.exit_code, 3);
  EXPECT_NE(ambiguous.err.find("'one' (float), 'two' (float)"), std::string::npos) << ambiguous.err;
  const Outcome chosen = run_dsc({"info", path, "--grid", "two", "--report", folder / "r.json"});
  ASSERT_EQ(chosen.exit_code, 0) << chosen.err;
  EXPECT_EQ(read_json(folder / "r.json")["input"]["voxels_inside"], 1000);
  EXPECT_EQ(read_json(folder / "r.json")["input"]["grid"], "two");
  EXPECT_EQ(run_dsc({"info", path, "--grid", "three"}).exit_code, 3);
  write_file(folder / "v.vol", "");
  const Outcome other = run_dsc({"info", folder / "v.vol", "--grid", "two"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("--grid"), std::string::npos) << other.err;
  EXPECT_EQ(run_dsc({"info", "shape:sphere", "--gridstep", "0.1", "--grid", "a"}).exit_code, 2);
  // --gridstep keeps what is inside.
  const Outcome stretched = run_dsc(
      {"info", path, "--grid", "one", "--gridstep", "1,2,3", "--report", folder / "r.json"});
  ASSERT_EQ(stretched.exit_code, 0) << stretched.err;
  EXPECT_EQ(read_json(folder / "r.json")["input"]["spacing"][2], 3);
}

TEST(Vdb, ABoxBeyondMemoryEndsWithFour) {
  const Folder folder;
  const std::string path = folder / "v.vdb";
  constexpr std::int32_t kFar = 1 << 30;
  write_vdb(path, {{.voxels = {{{-kFar, -kFar, -kFar}, 1}, {{kFar, kFar, kFar}, 1}}}});
  const Outcome outcome = run_dsc({"info", path});
  EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
  EXPECT_NE(outcome.err.find(path), std::string::npos) << outcome.err;
  EXPECT_LT(outcome.cpu_seconds, 2.);
  // Within 64 MB for the reader and what is left, by the bits that the program would need.
  write_vdb(path, {{.type = VdbType::boolean, .fills = {{{0, 0, 0}, {2047, 2047, 2047}, 1}}}});
  const Outcome limited = run_dsc({"info", path, "--max-memory", "100M"});
  EXPECT_EQ(limited.exit_code, 4) << limited.err;
  EXPECT_NE(limited.err.find(path), std::string::npos) << limited.err;
}

TEST(Vdb, ATruncatedFileIsExitCodeThree) {
  const Folder folder;
  const std::string path = folder / "v.vdb";
  write_vdb(path, {{.fills = {{{0, 0, 0}, {4, 4, 4}, 1}}}});
  const std::string bytes = read_file(path);
  write_file(path, bytes.substr(0, bytes.size() - 1));
  const Outcome outcome = run_dsc({"info", path});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find(path), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace dsc::test
