// --compare naive: both results are those of the runs that compute one of them.
#include "tests/cli/program.h"
#include "tests/io/result_parsers.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dsc::test {
namespace {

/// A ball of voxels in a file.
std::string ball_volume() {
  constexpr int kSize = 12;
  std::string voxels;
  for (int z = 0; z < kSize; ++z) {
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const double r2 = (x - 5.3) * (x - 5.3) + (y - 5.6) * (y - 5.6) + (z - 5.2) * (z - 5.2);
        voxels += r2 < 22 ? '\1' : '\0';
      }
    }
  }
  return "X: 12\nY: 12\nZ: 12\nVersion: 2\n.\n" + voxels;
}

std::vector<double> column(const PlyFile& file, const std::string& name) {
  const bool on_vertices = std::count(file.vertex_names.begin(), file.vertex_names.end(), name) > 0;
  return on_vertices ? file.vertex_columns({name}) : file.face_columns({name});
}

/// Runs `command` three times and compares the columns `names`.
void expect_both(const Words& command, const Words& names) {
  const Folder folder;
  const auto run = [&](const Words& more, const std::string& file) {
    Words all = command;
    all.insert(all.end(), more.begin(), more.end());
    all.insert(all.end(), {"-o", folder / file, "--report", folder / (file + ".json")});
    const Outcome outcome = run_dsc(all);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return read_ply(folder / file);
  };
  const PlyFile both = run({"--compare", "naive"}, "both.ply");
  const PlyFile projected = run({}, "projected.ply");
  const PlyFile naive = run({"--calculus", "naive"}, "naive.ply");
  for (const std::string& name : names) {
    EXPECT_EQ(column(both, name), column(projected, name)) << name;
    EXPECT_EQ(column(both, name + "_naive"), column(naive, name)) << name;
    EXPECT_NE(column(both, name + "_naive"), column(both, name)) << name;
  }
  // What the report says of the calculus and of the result is about the one that was asked for.
  const auto report = read_json(folder / "both.ply.json");
  const auto alone = read_json(folder / "projected.ply.json");
  for (const char* part : {"calculus", "result", "error"}) {
    ASSERT_EQ(report.contains(part), alone.contains(part)) << part;
    if (alone.contains(part)) {
      EXPECT_EQ(report[part], alone[part]) << part;
    }
  }
}

TEST(Compare, GivesBothResultsOfEveryCommand) {
  const Words sphere = {"shape:sphere", "--gridstep", "0.1"};
  const auto with = [&](Words words) {
    words.insert(words.begin() + 1, sphere.begin(), sphere.end());
    return words;
  };
  expect_both(with({"geodesic", "--source", "0,0,1"}), {"distance"});
  expect_both(with({"diffuse", "--source", "0,0,1", "--time", "0.1"}), {"heat"});
  expect_both(with({"gradient", "--function", "x*y+z"}), {"gx", "gy", "gz"});
  expect_both(with({"laplacian", "--function", "x^2"}), {"laplacian"});
  expect_both(with({"poisson", "--rhs", "x"}), {"solution"});
}

TEST(Compare, OfVoxelsTheLaplacianIsTakenWhereEachCalculusTakesIt) {
  const Folder folder;
  write_file(folder / "ball.vol", ball_volume());
  expect_both({"laplacian", folder / "ball.vol", "--function", "x^2"}, {"laplacian"});
}

TEST(Compare, ErrorsOfBothDistancesAreReported) {
  const Folder folder;
  const Words sphere = {"geodesic", "shape:sphere", "--gridstep", "0.1", "--source", "0,0,1"};
  const auto report = [&](const Words& more) {
    Words all = sphere;
    all.insert(all.end(), more.begin(), more.end());
    all.insert(all.end(), {"--report", folder / "r.json"});
    EXPECT_EQ(run_dsc(all).exit_code, 0);
    return read_json(folder / "r.json");
  };
  const auto both = report({"--compare", "naive"});
  const auto naive = report({"--calculus", "naive"});
  ASSERT_EQ(both["further_errors"].size(), 1U);
  EXPECT_EQ(both["further_errors"][0]["mean"], naive["error"]["mean"]);
  EXPECT_GT(both["further_errors"][0]["mean"], both["error"]["mean"]);
}

TEST(Compare, IsRefusedWhereTheCalculusIsNaiveAnyway) {
  const Folder folder;
  const Words sphere = {"geodesic", "shape:sphere", "--gridstep", "0.2", "--source", "0,0,1"};
  Words naive = sphere;
  naive.insert(naive.end(), {"--compare", "naive", "--calculus", "naive"});
  const Outcome twice = run_dsc(naive);
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_NE(twice.err.find("--compare"), std::string::npos) << twice.err;
  ASSERT_EQ(
      run_dsc({"surface", "shape:sphere", "--gridstep", "0.2", "-o", folder / "s.off"}).exit_code,
      0);
  const Outcome mesh =
      run_dsc({"geodesic", folder / "s.off", "--source-vertex", "0", "--compare", "naive"});
  EXPECT_EQ(mesh.exit_code, 2);
  EXPECT_NE(mesh.err.find("s.off"), std::string::npos) << mesh.err;
}

}  // namespace
}  // namespace dsc::test
