// Colour maps against what makes a map honest: in OKLab, equal steps, and lightness that tells more
// from less.
#include "libdsc/render/colormap.h"

#include "libdsc/base/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace dsc::render {
namespace {

std::vector<Lab> walk(const Colormap& map, int steps) {
  std::vector<Lab> path;
  for (int i = 0; i <= steps; ++i) path.push_back(lab_of(map(static_cast<double>(i) / steps)));
  return path;
}

double chroma(const Lab& lab) { return std::hypot(lab[1], lab[2]); }

TEST(Color, OkLabAndBackIsTheSame) {
  for (const Rgb& rgb : {Rgb(1, 1, 1), Rgb(0.2, 0.7, 0.1), Rgb(0, 0, 1), Rgb(0.01, 0.02, 0.9)}) {
    EXPECT_LT((rgb_of(lab_of(rgb)) - rgb).norm(), 1e-7);
  }
  // White is light and neutral, black is dark: the scale is right, whatever the matrices.
  EXPECT_LT((lab_of(Rgb(1, 1, 1)) - Lab(1, 0, 0)).norm(), 1e-6);
  EXPECT_LT(lab_of(Rgb(0, 0, 0)).norm(), 1e-12);
  // A grey of half the lightness has an eighth of the light.
  EXPECT_NEAR(lab_of(Rgb(0.125, 0.125, 0.125))[0], 0.5, 1e-6);
}

TEST(Color, EveryByteComesBack) {
  for (int i = 0; i < 256; ++i) {
    const auto byte = static_cast<std::uint8_t>(i);
    const Pixel pixel{byte, static_cast<std::uint8_t>(255 - i), 7};
    EXPECT_EQ(pixel_of(rgb_of(pixel)), pixel);
  }
}

TEST(Colormap, EqualStepsLookEqual) {
  for (const std::string& name : Colormap::names()) {
    const std::vector<Lab> path = walk(Colormap(name), 64);
    double length = 0;
    for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
    for (std::size_t i = 1; i < path.size(); ++i) {
      EXPECT_NEAR((path[i] - path[i - 1]).norm(), length / 64, 0.02 * length / 64)
          << name << " at " << i;
    }
  }
}

TEST(Colormap, LightnessRisesAllTheWay) {
  for (const std::string& name : Colormap::names()) {
    const Colormap map(name);
    if (map.diverging()) continue;
    const std::vector<Lab> path = walk(map, 500);
    for (std::size_t i = 1; i < path.size(); ++i) EXPECT_GT(path[i][0], path[i - 1][0]) << name;
    EXPECT_GT(path.back()[0] - path.front()[0], 0.55) << name;
  }
}

TEST(Colormap, TheArmsOfADivergingMapMirrorEachOther) {
  int diverging = 0;
  for (const std::string& name : Colormap::names()) {
    const Colormap map(name);
    if (!map.diverging()) continue;
    ++diverging;
    for (double t = 0; t < 0.5; t += 0.01) {
      const Lab a = lab_of(map(t)), b = lab_of(map(1 - t));
      EXPECT_NEAR(a[0], b[0], 1e-3);
      EXPECT_NEAR(chroma(a), chroma(b), 1e-3);
      EXPECT_LT(a[0], lab_of(map(t + 0.01))[0]);  // lightest in the middle
    }
    EXPECT_LT(chroma(lab_of(map(0.5))), 1e-5);
    EXPECT_GT((lab_of(map(0)) - lab_of(map(1))).norm(), 0.2);  // of different hues
  }
  EXPECT_EQ(diverging, 1);
}

TEST(Colormap, StaysInsideWhatAScreenShows) {
  for (const std::string& name : Colormap::names()) {
    const Colormap map(name);
    for (double t = 0; t <= 1; t += 1. / 1024) {
      EXPECT_GE(map(t).minCoeff(), 0) << name << " at " << t;
      EXPECT_LE(map(t).maxCoeff(), 1) << name << " at " << t;
    }
    EXPECT_EQ(map(-3), map(0));
    EXPECT_EQ(map(7), map(1));
  }
}

TEST(Colormap, AnUnknownNameIsRefusedWithTheKnownOnes) {
  try {
    Colormap map("rainbow");
    FAIL();
  } catch (const UsageError& error) {
    const std::string text = error.what();
    for (const std::string& name : Colormap::names()) {
      EXPECT_NE(text.find(name), std::string::npos) << text;
    }
  }
}

}  // namespace
}  // namespace dsc::render
