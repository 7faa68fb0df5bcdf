// Every subcommand gives the same files on any number of threads and in every run.
#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace dsc::test {
namespace {

/// The report without what may differ: how long it took, how much memory, on how many threads.
nlohmann::json comparable(nlohmann::json report, const std::string& folder) {
  for (const char* key : {"timings_s", "peak_memory_bytes"}) {
    EXPECT_EQ(report.erase(key), 1U) << key;
  }
  // Outputs and warnings name the folder of the run.
  std::string text = report.dump();
  for (std::size_t at = 0; (at = text.find(folder, at)) != std::string::npos;)
    text.erase(at, folder.size());
  return nlohmann::json::parse(text);
}

struct Files {
  std::map<std::string, std::string> bytes;
  nlohmann::json report;
};

/// The forms that a command is to write.
Words endings_of(const std::string& command) {
  if (command == "info") return {};
  if (command == "voxels") return {"vol", "longvol", "npy", "vti"};
  Words endings = {"ply", "vtp", "csv", "glb"};
  if (command == "surface") endings.insert(endings.end(), {"off", "obj", "stl", "om"});
  return endings + seen_endings();
}

Files files_of(Words words, const std::string& threads) {
  const Folder folder;
  for (const std::string& ending : endings_of(words[0])) {
    words.insert(words.end(), {"-o", folder / ("r." + ending)});
    if (ending == "png") words.insert(words.end(), {"--picture-size", "300,200"});
  }
  words.insert(words.end(), {"--quiet", "--threads", threads, "--report", folder / "r.json"});
  const Outcome outcome = run_dsc(words);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  Files files;
  for (const std::string& name : folder.names()) {
    if (name == "r.json") {
      files.report = comparable(read_json(folder / name), folder / "");
      continue;
    }
    files.bytes[name] = read_file(folder / name);
  }
  return files;
}

void expect_same(const Words& words) {
  std::string what;
  for (const std::string& word : words) what += word + " ";
  SCOPED_TRACE(what);
  const Files one = files_of(words, "1");
  ASSERT_EQ(one.bytes.size(), endings_of(words[0]).size());
  for (const char* threads : {"1", "2", "4", "8"}) {
    const Files other = files_of(words, threads);
    ASSERT_EQ(other.bytes.size(), one.bytes.size());
    for (const auto& [name, bytes] : one.bytes) {
      EXPECT_GT(bytes.size(), 80U) << name;
      EXPECT_TRUE(bytes == other.bytes.at(name)) << name << " on " << threads << " threads";
    }
    EXPECT_EQ(one.report, other.report) << threads << " threads";
  }
}

const Words kManyFaces = {"shape:sphere", "--gridstep",
                          "0.03"};  // 20 866 faces: chunks of every loop

Words on(Words command, const Words& input) {
  command.insert(command.end(), input.begin(), input.end());
  return command;
}

TEST(SameBits, OfSurfaceNormalsAndCurvature) {
  expect_same(on({"info"}, kManyFaces));
  expect_same(on({"voxels"}, kManyFaces));
  expect_same(on({"surface"}, kManyFaces));
  expect_same(on({"surface", "--regularise"}, kManyFaces));
  for (const char* estimator : {"ii", "trivial", "analytic"}) {
    expect_same(on({"normals", "--estimator", estimator}, kManyFaces));
  }
  expect_same(on({"curvature"}, kManyFaces));
  expect_same(on({"curvature", "--estimator", "laplacian"}, kManyFaces));
}

TEST(SameBits, OfFunctionsAndSolutions) {
  expect_same(on({"gradient", "--function", "sin(3*x)*y"}, kManyFaces));
  expect_same(on({"laplacian", "--function", "x^2+y*z"}, kManyFaces));
  expect_same(on({"laplacian", "--function", "x^2", "--diffuse", "0.001"}, kManyFaces));
  expect_same(on({"diffuse", "--source", "0,0,1", "--time", "0.01"}, kManyFaces));
  expect_same(on({"poisson", "--rhs", "x*y"}, kManyFaces));
  expect_same(on({"spectrum", "-k", "8"}, {"shape:torus,R=1,r=0.4", "--gridstep", "0.05"}));
}

TEST(SameBits, OfDistances) {
  expect_same(on({"geodesic", "--source", "0,0,1", "--source", "1,0,0"}, kManyFaces));
  expect_same(on({"geodesic", "--source-vertex", "0", "--calculus", "naive"}, kManyFaces));
  expect_same({"geodesic", "--source-vertex", "5", "shape:plane,nx=1,ny=2,nz=3,size=2",
               "--gridstep", "0.03"});
}

/// Beyond 150 000 unknowns systems are solved by multigrid, whose sums over all unknowns are the
/// ones that an order of threads would change first.
TEST(SameBits, OfLargeSystems) {
  const Words large = {"shape:sphere", "--gridstep", "0.011", "--estimator", "trivial"};
  expect_same(on({"poisson", "--rhs", "x*y"}, large));
  expect_same(on({"geodesic", "--source", "0,0,1"}, large));
}

/// Labels, a mesh, and where surfaces are pinched.
TEST(SameBits, OfFiles) {
  const Folder folder;
  std::mt19937 random(2);
  std::string voxels = "X: 18\nY: 16\nZ: 14\nVoxel-Size: 1\nVersion: 2\n.\n";
  for (int i = 0; i < 18 * 16 * 14; ++i) voxels += static_cast<char>(random() % 4);
  write_file(folder / "labels.vol", voxels);
  ASSERT_EQ(run_dsc(on({"surface", "-o", folder / "mesh.ply"}, kManyFaces)).exit_code, 0);
  for (const Words& input :
       {Words{folder / "labels.vol", "--labels", "all"}, Words{folder / "mesh.ply"}}) {
    expect_same(on({"info"}, input));
    if (input.size() > 1) expect_same(on({"voxels"}, input));  // a mesh has none
    expect_same(on({"surface"}, input));
    expect_same(on({"normals"}, input));
    expect_same(on({"gradient", "--function", "x*y"}, input));
    expect_same(on({"geodesic", "--source-vertex", "0"}, input));
  }
  const std::string spot = test_data("spot-128.vol");
  if (spot.empty()) return;
  expect_same({"geodesic", spot, "--source-vertex", "0"});
  expect_same({"curvature", spot});
  expect_same({"poisson", spot, "--rhs", "x"});
}

}  // namespace
}  // namespace dsc::test
