// What the program says to a command line: texts, refusals, exit codes.
#include "tests/cli/program.h"

#include <gtest/gtest.h>

namespace dsc::test {
namespace {

const std::vector<std::string> kCommands = {"info",     "surface",   "normals", "curvature",
                                            "gradient", "laplacian", "poisson", "diffuse",
                                            "geodesic", "spectrum",  "voxels"};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(CommandLine, HelpNamesEveryCommandShapeAndExitCode) {
  const Outcome outcome = run_dsc({"--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  for (const std::string& command : kCommands) EXPECT_TRUE(contains(outcome.out, command));
  for (const std::string word : {"sphere", "torus", "goursat", "expr:", ".vtp", "130"}) {
    EXPECT_TRUE(contains(outcome.out, word)) << word;
  }
}

TEST(CommandLine, EveryCommandHasHelpWithExamplesThatAreAccepted) {
  for (const std::string& command : kCommands) {
    const Outcome outcome = run_dsc({command, "--help"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_TRUE(contains(outcome.out, "--report")) << command;
    EXPECT_TRUE(contains(outcome.out, "dsc " + command)) << command;
    EXPECT_TRUE(contains(outcome.out, "Examples:")) << command;
  }
}

TEST(CommandLine, VersionIsTheProjects) {
  EXPECT_EQ(run_dsc({"--version"}).out, "dsc " DSC_VERSION "\n");
}

TEST(CommandLine, WhatIsWrongIsNamedWithExitCodeTwo) {
  const std::string sphere = "shape:sphere";
  expect_refused(run_dsc({}), 2, {"--help"});
  expect_refused(run_dsc({"frobnicate"}), 2, {"frobnicate", "--help"});
  expect_refused(run_dsc({"info"}), 2, {"INPUT"});
  expect_refused(run_dsc({"info", sphere}), 2, {"--gridstep"});
  expect_refused(run_dsc({"info", sphere, "--gridstep", "0"}), 2, {"--gridstep", "positive"});
  expect_refused(run_dsc({"info", sphere, "--gridstep", "0.1,0.1"}), 2, {"--gridstep"});
  expect_refused(run_dsc({"info", sphere, "--gridstep", "nan"}), 2, {"nan"});
  expect_refused(run_dsc({"info", sphere, "--gridstep", "0.1x"}), 2, {"0.1x"});
  expect_refused(run_dsc({"info", "shape:cube", "--gridstep", "0.1"}), 2, {"cube", "sphere"});
  expect_refused(run_dsc({"info", "shape:sphere,q=1", "--gridstep", "0.1"}), 2, {"q"});
  expect_refused(run_dsc({"info", sphere, "--gridstep", "0.1", "--frob"}), 2, {"--frob"});
  expect_refused(run_dsc({"info", sphere, "--gridstep", "0.1", "--label", "1"}), 2, {"--label"});
  expect_refused(run_dsc({"info", "a.vol", "--threshold", "3,2"}), 2, {"--threshold", "LO"});
  expect_refused(run_dsc({"info", sphere, "--gridstep", "0.1", "--labels", "all"}), 2,
                 {"--labels", "shape"});
  expect_refused(run_dsc({"info", "a.vol", "--labels", "some"}), 2, {"--labels", "all"});
  expect_refused(run_dsc({"info", "a.vol", "--labels", "all", "--label", "3"}), 2, {"--label"});
  expect_refused(run_dsc({"info", "a.vol", "--labels", "all", "--between", "3,4"}), 2,
                 {"--between"});
  for (const std::string pair : {"3", "3,3", "3,4,5", "-1,2", "1.5,2", "1,4294967296"}) {
    expect_refused(run_dsc({"info", "a.vol", "--between=" + pair}), 2, {"--between", pair, "A,B"});
  }
  expect_refused(run_dsc({"normals", "a.vol", "--labels", "all", "--centre", "pair"}), 2,
                 {"--centre pair"});
  expect_refused(run_dsc({"info", "a.raw"}), 2, {"a.raw", "--size", "--type"});
  expect_refused(run_dsc({"info", "a.raw", "--size", "2,2,2"}), 2, {"--type"});
  expect_refused(run_dsc({"info", "a.raw", "--type", "u8"}), 2, {"--size"});
  expect_refused(run_dsc({"info", "a.raw", "--type", "u9", "--size", "2,2,2"}), 2, {"u9", "f64"});
  expect_refused(run_dsc({"info", "a.raw", "--type", "u8", "--size", "2,2"}), 2, {"--size"});
  expect_refused(run_dsc({"info", "a.raw", "--type", "u8", "--size", "2,2,0"}), 2, {"--size"});
  expect_refused(run_dsc({"info", "a.raw", "--endian", "middle"}), 2, {"--endian", "little"});
  expect_refused(run_dsc({"info", "a.raw", "--offset", "-1"}), 2, {"--offset"});
  expect_refused(run_dsc({"info", sphere, "--gridstep", "1", "--size", "2,2,2", "--type", "u8"}), 2,
                 {"--size", "shape"});
  expect_refused(run_dsc({"surface", sphere, "--gridstep", "0.1"}), 2, {"--output"});
  expect_refused(run_dsc({"normals", sphere, "--gridstep", "0.1", "--estimator", "best"}), 2,
                 {"--estimator", "ii", "trivial", "analytic"});
  expect_refused(run_dsc({"normals", "a.vol", "--estimator", "analytic"}), 2, {"analytic"});
  expect_refused(run_dsc({"normals", sphere, "--gridstep", "0.1", "--radius", "-1"}), 2,
                 {"--radius"});
  expect_refused(run_dsc({"gradient", sphere, "--gridstep", "0.1"}), 2, {"--function"});
  expect_refused(run_dsc({"gradient", sphere, "--gridstep", "0.1", "--function", "x+"}), 2, {"x+"});
  expect_refused(run_dsc({"diffuse", sphere, "--gridstep", "0.1", "--time", "1"}), 2, {"--source"});
  expect_refused(run_dsc({"diffuse", sphere, "--gridstep", "0.1", "--source", "0,0,1"}), 2,
                 {"--time"});
  expect_refused(run_dsc({"geodesic", sphere, "--gridstep", "0.1"}), 2, {"--source"});
  expect_refused(run_dsc({"geodesic", sphere, "--gridstep", "0.1", "--source", "0,0"}), 2,
                 {"x,y,z"});
  expect_refused(run_dsc({"geodesic", sphere, "--gridstep", "0.1", "--source-vertex", "999999"}), 2,
                 {"999999", "0 to"});
  expect_refused(run_dsc({"info", sphere, "--gridstep", "0.1", "--threads", "0"}), 2,
                 {"--threads"});
}

TEST(CommandLine, AnAbsurdStabilisationIsRefusedByItsName) {
  const std::vector<std::string> sphere = {"shape:sphere", "--gridstep", "0.1", "--lambda"};
  for (const std::string value : {"1e7", "1e308"}) {
    for (std::vector<std::string> command :
         {std::vector<std::string>{"diffuse", "--source", "0,0,1", "--time", "1"},
          {"curvature", "--estimator", "laplacian"}}) {
      command.insert(command.end(), sphere.begin(), sphere.end());
      command.push_back(value);
      expect_refused(run_dsc(command), 2, {"lambda", "1e6"});
    }
  }
}

TEST(CommandLine, AStabilisationIsRefusedWhereItHasNoEffectOrNoSense) {
  const std::vector<std::string> sphere = {"shape:sphere", "--gridstep", "0.1"};
  const auto refused = [&](std::vector<std::string> all, const std::vector<std::string>& words) {
    all.insert(all.end(), sphere.begin(), sphere.end());
    expect_refused(run_dsc(all), 2, words);
  };
  refused({"spectrum", "--stabilisation", "some"}, {"--stabilisation", "mercat", "elements"});
  refused({"spectrum", "--stabilisation", "mercat", "--lambda", "1"}, {"--lambda", "mercat"});
  refused({"gradient", "--function", "x", "--stabilisation", "mercat"}, {"--stabilisation"});
  refused({"gradient", "--function", "x", "--lambda", "1"}, {"--lambda"});
  refused({"diffuse", "--source", "0,0,1", "--time", "1", "--stabilisation", "mercat"},
          {"--stabilisation mercat", "checkerboard"});
}

TEST(CommandLine, AnOptionThatCouldChangeNothingIsRefused) {
  const auto refused = [](std::vector<std::string> more, const std::vector<std::string>& words) {
    std::vector<std::string> all = {"gradient", "shape:sphere", "--gridstep",
                                    "0.2",      "--function",   "x"};
    all.insert(all.end(), more.begin(), more.end());
    expect_refused(run_dsc(all), 2, words);
  };
  for (const std::string estimator : {"trivial", "analytic"}) {
    refused({"--estimator", estimator, "--radius", "0.5"}, {"--radius", "--estimator", estimator});
    refused({"--centre", "pair", "--estimator", estimator}, {"--centre", "--estimator", estimator});
    refused({"--centre", "surfel", "--estimator", estimator}, {"--centre"});
  }
  refused({"--calculus", "naive", "--radius", "0.5"}, {"--radius", "--calculus naive"});
  refused({"--calculus", "naive", "--centre", "pair"}, {"--centre", "--calculus naive"});
  refused({"--calculus", "naive", "--estimator", "ii"}, {"--estimator", "--calculus naive"});
}

TEST(CommandLine, AnUnknownEndingIsRefusedBeforeTheInputIsRead) {
  expect_refused(run_dsc({"surface", "missing.vol", "-o", "a.xyz"}), 2,
                 {"a.xyz", ".ply", ".vtp", ".csv"});
}

TEST(CommandLine, AnInputThatCannotBeReadIsExitCodeThree) {
  const Folder folder;
  expect_refused(run_dsc({"info", folder / "missing.vol"}), 3, {"missing.vol"});
  write_file(folder / "broken.vol", "this is no volume\n");
  expect_refused(run_dsc({"info", folder / "broken.vol"}), 3, {"broken.vol"});
  expect_refused(run_dsc({"info", "shape:sphere,r=0.01,cx=0.25", "--gridstep", "0.5"}), 3,
                 {"no voxel", "--gridstep"});
}

TEST(CommandLine, AGridTooFineForMemoryIsExitCodeFour) {
  for (const std::string h : {"1e-4", "1e-7", "1e-9"}) {  // memory, 64 bits, the longest axis
    expect_refused(run_dsc({"info", "shape:sphere", "--gridstep", h}), 4, {"--gridstep", "larger"});
  }
  expect_refused(run_dsc({"normals", "shape:plane", "--gridstep", "1e-6"}), 4, {"--gridstep"});
}

TEST(CommandLine, AHeaderBeyondAllLimitsIsExitCodeFour) {
  const Folder folder;
  write_file(folder / "huge.vol", "X: 4000000000\nY: 4000000000\nZ: 4000000000\nVersion: 2\n.\n");
  expect_refused(run_dsc({"info", folder / "huge.vol"}), 4, {"huge.vol", "4000000000"});
}

}  // namespace
}  // namespace dsc::test
