// -o FILE.png, as a user asks for it.
#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>

#ifdef DSC_WITH_PICTURES
#include <png.h>
#endif

namespace dsc::test {
namespace {

const Words kDistances = {"geodesic", "shape:sphere", "--gridstep", "0.1", "--source", "0,0,1"};

TEST(Pictures, OptionsAboutThemNeedOne) {
  const Folder folder;
  for (const Words& option : std::vector<Words>{{"--view", "top"},
                                                {"--up", "y"},
                                                {"--picture-size", "100,100"},
                                                {"--field", "distance"},
                                                {"--range", "0,1"},
                                                {"--colormap", "grey"},
                                                {"--isolines", "3"},
                                                {"--shading", "flat"},
                                                {"--glyphs", "3"}}) {
    expect_refused(run_dsc(kDistances + Words{"-o", folder / "x.ply"} + option), 2,
                   {option[0], "-o FILE.png"});
  }
  EXPECT_EQ(folder.names(), Words{});
}

#ifndef DSC_WITH_PICTURES

TEST(Pictures, ABuildWithoutSaysHowToGetOne) {
  const Folder folder;
  expect_refused(run_dsc(kDistances + Words{"-o", folder / "x.png"}), 2,
                 {"DSC_WITH_PICTURES", "libembree-dev"});
  EXPECT_EQ(folder.names(), Words{});
}

#else

struct Seen {
  int width = 0, height = 0;
  std::vector<std::array<std::uint8_t, 3> > pixels;
  const std::array<std::uint8_t, 3>& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y * width + x)];
  }
};

Seen read_png(const std::string& path) {
  png_image control{};
  control.version = PNG_IMAGE_VERSION;
  Seen seen;
  EXPECT_NE(png_image_begin_read_from_file(&control, path.c_str()), 0) << path;
  control.format = PNG_FORMAT_RGB;
  seen.width = static_cast<int>(control.width);
  seen.height = static_cast<int>(control.height);
  seen.pixels.resize(static_cast<std::size_t>(seen.width) * static_cast<std::size_t>(seen.height));
  EXPECT_NE(png_image_finish_read(&control, nullptr, seen.pixels.data(), 0, nullptr), 0);
  return seen;
}

constexpr std::array<std::uint8_t, 3> kWhite{255, 255, 255};

TEST(Pictures, DistancesFromTheNorthPoleGrowDownwards) {
  const Folder folder;
  const Outcome outcome =
      run_dsc(kDistances + Words{"-o", folder / "x.png", "-o", folder / "x.ply", "--view", "front",
                                 "--picture-size", "320,240", "--colormap", "grey", "--isolines",
                                 "0", "--report", folder / "r.json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(folder.names(), (Words{"r.json", "x.ply", "x.png"}));
  const Seen seen = read_png(folder / "x.png");
  ASSERT_EQ(seen.width, 320);
  ASSERT_EQ(seen.height, 240);
  // The sphere: 218 pixels across, in the middle of what the bar leaves.
  int left = 0, right = 0;
  while (seen.at(left, 120) == kWhite) ++left;
  for (right = left; seen.at(right, 120) != kWhite; ++right) {
  }
  EXPECT_NEAR(right - left, 240 - 2 * 0.045 * 240, 3);
  const int middle = (left + right) / 2;
  EXPECT_LT(seen.at(middle, 20)[0], 0.7 * seen.at(middle, 120)[0]);
  EXPECT_LT(seen.at(middle, 100)[0], seen.at(middle, 180)[0]);

  const auto report = read_json(folder / "r.json");
  ASSERT_EQ(report["pictures"].size(), 1U);
  const auto& picture = report["pictures"][0];
  EXPECT_EQ(picture["field"], "distance");
  EXPECT_EQ(picture["colormap"], "grey");
  EXPECT_EQ(picture["range"][0], 0.);
  EXPECT_EQ(picture["range"][1], report["result"]["max"]);
  EXPECT_EQ(picture["infinite"], 0);
}

TEST(Pictures, EveryCommandWithAResultDrawsIt) {
  const Folder folder;
  const Words shape = {"shape:torus", "--gridstep", "0.2", "--picture-size", "80,60", "--quiet"};
  const std::vector<Words> commands = {{"surface"},
                                       {"surface", "--regularise"},
                                       {"normals", "--glyphs", "20"},
                                       {"gradient", "--function", "x*y", "--glyphs", "20"},
                                       {"diffuse", "--source", "3,0,0", "--time", "0.1"},
                                       {"geodesic", "--source", "3,0,0", "--calculus", "naive"},
                                       {"spectrum", "-k", "3", "--field", "eigenvector_2"},
                                       {"curvature", "--field", "kappa_1"},
                                       {"curvature", "--field", "direction_1", "--glyphs", "9"},
                                       {"curvature", "--on", "vertex", "--isolines", "4"},
                                       {"laplacian", "--function", "z", "--field", "function"},
                                       {"poisson", "--rhs", "x"}};
  for (const Words& command : commands) {
    const std::string path = folder / "x.png";
    const Outcome outcome = run_dsc(Words{command[0]} + shape +
                                    Words(command.begin() + 1, command.end()) + Words{"-o", path});
    ASSERT_EQ(outcome.exit_code, 0) << command[0] << outcome.err;
    const Seen seen = read_png(path);
    EXPECT_GT(std::count_if(seen.pixels.begin(), seen.pixels.end(),
                            [](const auto& p) { return p != kWhite; }),
              500)
        << command[0];
  }
}

TEST(Pictures, OptionsWithoutEffectAreRefusedBeforeAnythingIsRead) {
  const Folder folder;
  const auto refused = [&](const Words& command, const Words& option) {
    const Words picture = {folder / "missing.vol", "-o", folder / "x.png"};
    expect_refused(run_dsc(command + picture + option), 2, {option[0], "leave it out"});
  };
  const Words geodesic = {"geodesic", "--source-vertex", "0"};
  refused({"surface"}, {"--range", "0,1"});
  refused({"surface"}, {"--colormap", "ember"});
  refused({"surface"}, {"--isolines", "5"});
  refused({"surface"}, {"--glyphs", "5"});
  refused({"normals"}, {"--range", "0,1"});
  refused({"normals"}, {"--isolines", "5"});
  refused({"gradient", "--function", "x"}, {"--isolines", "5"});
  refused({"curvature"}, {"--isolines", "5"});
  refused(geodesic, {"--glyphs", "5"});
  const Words shape = {"curvature", "shape:sphere", "--gridstep", "0.2", "-o", folder / "x.png"};
  expect_refused(run_dsc(shape + Words{"--field", "kappa_1", "--isolines", "5"}), 2,
                 {"--isolines", "kappa_1"});
  expect_refused(run_dsc(shape + Words{"--field", "kappa_3"}), 2, {"kappa_3", "kappa_2"});
  expect_refused(run_dsc({"surface", "shape:sphere", "--gridstep", "0.2", "--shading", "true", "-o",
                          folder / "x.png"}),
                 2, {"--shading true"});
  EXPECT_EQ(folder.names(), Words{});
}

TEST(Pictures, BadValuesAreRefusedWithWhatIsExpected) {
  const Folder folder;
  const Words call = kDistances + Words{"-o", folder / "x.png"};
  const auto refused = [&](const Words& option, const std::string& word) {
    expect_refused(run_dsc(call + option), 2, {word});
  };
  refused({"--view", "above"}, "front, back");
  refused({"--view", "0,100"}, "elevation");
  refused({"--up", "w"}, "--up");
  refused({"--picture-size", "10,10"}, "16 to 16384");
  refused({"--picture-size", "100"}, "W,H");
  refused({"--range", "1,0"}, "LO < HI");
  refused({"--colormap", "jet"}, "lagoon");
  refused({"--isolines", "-1"}, "whole number");
  refused({"--isolines", "2.5"}, "whole number");
  expect_refused(run_dsc(kDistances + Words{"-o", folder / "no/x.png"}), 3, {"does not exist"});
  expect_refused(run_dsc(call + Words{"-o", folder / "x.png"}), 2, {"twice"});
  EXPECT_EQ(folder.names(), Words{});
}

TEST(Pictures, WhatNoSourceReachesIsGreyAndSaidToBe) {
  const Folder folder;
  const std::string input = folder / "two.vol";
  write_file(input, "X: 5\nY: 1\nZ: 1\nVersion: 2\n.\n" + std::string("\1\0\0\0\1", 5));
  const Outcome outcome =
      run_dsc({"geodesic", input, "--source", "0,0,0", "--calculus", "naive", "--view", "front",
               "--picture-size", "400,200", "-o", folder / "x.png", "--report", folder / "r.json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("8 infinite values are grey"), std::string::npos) << outcome.err;
  EXPECT_EQ(read_json(folder / "r.json")["pictures"][0]["infinite"], 8);
  // The other voxel, the right one of two, is grey: its three bytes are equal.
  const Seen seen = read_png(folder / "x.png");
  int grey = 0, coloured = 0;
  for (int x = 0; x < 338; ++x) {
    const auto& p = seen.at(x, 100);
    if (p == kWhite) continue;
    const bool same = std::abs(p[0] - p[1]) < 3 && std::abs(p[1] - p[2]) < 3;
    (same ? grey : coloured) += 1;
  }
  EXPECT_GT(grey, 30);
  EXPECT_GT(coloured, 30);
}

TEST(Pictures, RegionsOfALabelImageHaveColoursOfTheirOwn) {
  const Folder folder;
  const std::string input = folder / "labels.vol";
  write_file(input, "X: 2\nY: 1\nZ: 1\nVersion: 2\n.\n" + std::string("\1\2", 2));
  const Outcome outcome =
      run_dsc({"surface", input, "--labels", "all", "--view", "front", "--picture-size", "400,200",
               "-o", folder / "x.png", "--report", folder / "r.json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(read_json(folder / "r.json")["pictures"][0]["field"], "label");
  const Seen seen = read_png(folder / "x.png");
  int left = 0, right = 0;
  while (seen.at(left, 100) == kWhite) ++left;
  for (right = left; seen.at(right, 100) != kWhite; ++right) {
  }
  const auto one = seen.at(left + (right - left) / 4, 100);
  const auto two = seen.at(left + 3 * (right - left) / 4, 100);
  EXPECT_EQ(one, seen.at(left + 5, 60));
  EXPECT_EQ(two, seen.at(right - 5, 140));
  int difference = 0;
  for (std::size_t i = 0; i < 3; ++i) difference += std::abs(one[i] - two[i]);
  EXPECT_GT(difference, 60);
}

TEST(Pictures, AnyNumberOfThreadsWritesTheSameFile) {
  const Folder folder;
  for (const char* threads : {"1", "3"}) {
    const std::string path = folder / (std::string(threads) + ".png");
    ASSERT_EQ(
        run_dsc(kDistances + Words{"-o", path, "--picture-size", "300,200", "--threads", threads})
            .exit_code,
        0);
  }
  EXPECT_EQ(read_file(folder / "1.png"), read_file(folder / "3.png"));
}

#endif

}  // namespace
}  // namespace dsc::test
