// Every subcommand gives the same files on any number of threads and in every run.
#include "libdsc/base/types.h"
#include "tests/cli/program.h"
#include "tests/io/image_bytes.h"
#ifdef DSC_TEST_VDB
#include "tests/support/vdb_files.h"
#endif

#include <gtest/gtest.h>
#include <Eigen/Geometry>

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

Files files_of(Words words, const Words& endings, const std::string& threads) {
  const Folder folder;
  for (const std::string& ending : endings) {
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

void expect_same_in(const Words& endings, const Words& words,
                    const Words& all_threads = {"1", "2", "4", "8"}) {
  std::string what;
  for (const std::string& word : words) what += word + " ";
  SCOPED_TRACE(what);
  const Files one = files_of(words, endings, "1");
  ASSERT_EQ(one.bytes.size(), endings.size());
  for (const std::string& threads : all_threads) {
    const Files other = files_of(words, endings, threads);
    ASSERT_EQ(other.bytes.size(), one.bytes.size());
    for (const auto& [name, bytes] : one.bytes) {
      EXPECT_GT(bytes.size(), 80U) << name;
      EXPECT_TRUE(bytes == other.bytes.at(name)) << name << " on " << threads << " threads";
    }
    EXPECT_EQ(one.report, other.report) << threads << " threads";
  }
}

void expect_same(const Words& words) { expect_same_in(endings_of(words[0]), words); }

/// What an option changes is computed before it is written, and .ply holds every bit of it.
void expect_same_numbers(const Words& words) { expect_same_in({"ply"}, words, {"2", "8"}); }

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

const Words kSomeFaces = {"shape:sphere", "--gridstep", "0.04"};  // 11 700 faces: some chunks
const Words kBounded = {"shape:plane,nx=1,ny=2,nz=3,size=2", "--gridstep", "0.03"};

TEST(SameBits, OfOptionsOfTheCalculus) {
  const Words source = {"--source", "0,0,1"};
  const Words jobs[] = {{"laplacian", "--function", "x^2+y*z"},
                        {"poisson", "--rhs", "x*y"},
                        {"spectrum", "-k", "6"},
                        Words{"geodesic"} + source,
                        Words{"diffuse", "--time", "0.01"} + source};
  for (const char* stabilisation : {"mercat", "elements", "refinement"}) {
    for (const Words& job : jobs) {
      // A point source is half a checkerboard, which mercat would leave: refused.
      if (job[0] == "diffuse" && stabilisation == std::string("mercat")) continue;
      expect_same_numbers(on(job + Words{"--stabilisation", stabilisation}, kSomeFaces));
    }
  }
  for (const Words& job : jobs) {
    expect_same_numbers(on(job + Words{"--calculus", "naive", "--lambda", "0.5"}, kSomeFaces));
    if (job[0] == "spectrum") continue;
    expect_same_numbers(on(job + Words{"--compare", "naive"}, kSomeFaces));
  }
  // A page shows both fields.
  expect_same(on({"gradient", "--function", "sin(3*x)*y", "--compare", "naive"}, kSomeFaces));
}

TEST(SameBits, OfOptionsOfTheCommands) {
  for (const char* method : {"direct", "bands"}) {
    expect_same_numbers(on({"geodesic", "--source", "0,0,1", "--method", method}, kSomeFaces));
    for (const char* boundary : {"neumann", "mixed"}) {
      expect_same_numbers(on({"geodesic", "--source-vertex", "5", "--method", method, "--boundary",
                              boundary, "--time", "0.002"},
                             kBounded));
    }
  }
  for (const char* stabilisation : {"de-goes", "mercat", "elements", "refinement"}) {
    expect_same_numbers(
        on({"poisson", "--rhs", "x", "--fix", "y*z", "--stabilisation", stabilisation}, kBounded));
  }
  for (const Words& curvature :
       {Words{"--on", "vertex"}, Words{"--form", "plain"},
        Words{"--form", "plain", "--on", "vertex", "--radius", "0.3"},
        Words{"--estimator", "laplacian", "--diffuse", "0.001", "--lambda", "0.1"}}) {
    expect_same_numbers(on(Words{"curvature"} + curvature, kSomeFaces));
  }
  expect_same_numbers(on({"normals", "--centre", "pair", "--radius", "0.3"}, kSomeFaces));
  expect_same_numbers(on({"normals", "--adjacency", "exterior"},
                         {"shape:goursat", "--gridstep", "0.15", "--border", "open"}));
  if (const Words seen = seen_endings(); !seen.empty() && seen[0] == "png") {
    expect_same_in({"png"}, on({"normals", "--view", "iso", "--up", "-y", "--glyphs", "300",
                                "--shading", "flat"},
                               kSomeFaces));
    expect_same_in({"png"},
                   on({"geodesic", "--source", "0,0,1", "--isolines", "40", "--range", "0.5,2",
                       "--colormap", "ember", "--compare", "naive", "--field", "distance_naive"},
                      kSomeFaces));
  }
}

/// Beyond 150 000 unknowns systems are solved by multigrid, whose sums over all unknowns are the
/// ones that an order of threads would change first.
TEST(SameBits, OfLargeSystems) {
  const Words large = {"shape:sphere", "--gridstep", "0.011", "--estimator", "trivial"};
  expect_same(on({"poisson", "--rhs", "x*y"}, large));
  expect_same(on({"geodesic", "--source", "0,0,1"}, large));
}

/// 18 x 16 x 14 random labels from 0 to 3: 10 000 faces, pinched everywhere.
void write_labels(const std::string& path) {
  std::mt19937 random(2);
  std::string voxels = "X: 18\nY: 16\nZ: 14\nVoxel-Size: 1\nVersion: 2\n.\n";
  for (int i = 0; i < 18 * 16 * 14; ++i) voxels += static_cast<char>(random() % 4);
  write_file(path, voxels);
}

/// Labels, a mesh, and where surfaces are pinched.
TEST(SameBits, OfFiles) {
  const Folder folder;
  write_labels(folder / "labels.vol");
  ASSERT_EQ(run_dsc(on({"surface", "-o", folder / "mesh.ply"}, kManyFaces)).exit_code, 0);
  for (const Words& input :
       {Words{folder / "labels.vol", "--labels", "all"}, Words{folder / "mesh.ply"}}) {
    expect_same(on({"info"}, input));
    if (input.size() > 1) expect_same(on({"voxels"}, input));  // a mesh has none
    expect_same(on({"surface"}, input));
    expect_same(on({"normals"}, input));
    expect_same(on({"gradient", "--function", "x*y"}, input));
    expect_same(on({"geodesic", "--source-vertex", "0"}, input));
    expect_same(on({"diffuse", "--source-vertex", "0", "--time", "0.01"}, input));
    expect_same(on({"laplacian", "--function", "x*y"}, input));
    expect_same(on({"poisson", "--rhs", "x+y*z"}, input));
    expect_same(on({"spectrum", "-k", "4"}, input));
    expect_same(on({"curvature"}, input));
  }
  const std::string spot = test_data("spot-128.vol");
  if (spot.empty()) return;
  expect_same({"geodesic", spot, "--source-vertex", "0"});
  expect_same({"curvature", spot});
  expect_same({"poisson", spot, "--rhs", "x"});
}

TEST(SameBits, OfOptionsOfLabels) {
  const Folder folder;
  write_labels(folder / "labels.vol");
  const std::string labels = folder / "labels.vol";
  for (const Words& chosen :
       {Words{"--between", "1,2"}, Words{"--between", "1,2", "--between", "0,3"},
        Words{"--labels", "all", "--border", "open", "--adjacency", "exterior"},
        Words{"--label", "1", "--label", "3", "--border", "open"},
        Words{"--threshold", "2,3", "--border", "open"}}) {
    const Words input = Words{labels} + chosen;
    expect_same_numbers(on({"normals"}, input));
    expect_same_numbers(on({"poisson", "--rhs", "x", "--fix", "y", "--calculus", "naive"}, input));
    expect_same_numbers(on({"geodesic", "--source-vertex", "3", "--boundary", "neumann"}, input));
  }
}

/// The other readers, and places in the world where the file has one.
TEST(SameBits, OfOtherVolumes) {
  const Folder folder;
  ASSERT_EQ(run_dsc(on({"voxels", "-o", folder / "v.vti", "-o", folder / "v.npy", "-o",
                        folder / "v.longvol", "--quiet"},
                       kSomeFaces))
                .exit_code,
            0);
  Words volumes = {"v.vti", "v.npy", "v.longvol"};
#ifdef DSC_IMAGE_READER
  constexpr Index n = 50;
  volumes.emplace_back("v.mha");
  TestImage image{{n, n, n}, {1, 0.75, 1.5}, test_direction(-1), {-20, 100, 7}, {}};
  for (Index z = 0; z < n; ++z) {
    for (Index y = 0; y < n; ++y) {
      for (Index x = 0; x < n; ++x) {
        image.values.push_back((Vec3(x, y, z) - Vec3(24, 25, 24.5)).norm() < 22 ? 5 : 0);
      }
    }
  }
  write_file(folder / "v.mha", mha_bytes(image));
#endif
#ifdef DSC_TEST_VDB
  volumes.emplace_back("v.vdb");
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = 0.1 * test_direction(1);
  matrix.topRightCorner<3, 1>() = Vec3(-20, 100, 7);
  write_vdb_ball(folder / "v.vdb", "ball", 20.3, Vec3(2.3, -7.2, 3.1), matrix);
#endif
  for (const std::string& name : volumes) {
    expect_same_in({"npy"}, {"voxels", folder / name}, {"2", "8"});
    expect_same_numbers({"normals", folder / name});
    expect_same_numbers({"poisson", folder / name, "--rhs", "x"});
    expect_same_in({"vtp"}, {"geodesic", folder / name, "--source-vertex", "0"}, {"2", "8"});
  }
}

}  // namespace
}  // namespace dsc::test
