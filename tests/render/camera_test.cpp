// The camera: which side is seen from where, and what is up.
#include "libdsc/render/camera.h"

#include "libdsc/base/error.h"
#include "tests/render/meshes.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <map>

namespace dsc::render {
namespace {

TEST(View, NamesSayWhereTheViewerStands) {
  const std::map<std::string, Vec3> viewers = {{"front", {0, -1, 0}}, {"back", {0, 1, 0}},
                                               {"right", {1, 0, 0}},  {"left", {-1, 0, 0}},
                                               {"top", {0, 0, 1}},    {"bottom", {0, 0, -1}}};
  for (const auto& [name, viewer] : viewers) {
    EXPECT_LT((View::of(name).frame().col(2) - viewer).norm(), 1e-12) << name;
  }
  const Vec3 iso = View::of("iso").frame().col(2);
  EXPECT_LT((iso - Vec3(1, -1, 1).normalized()).norm(), 1e-12);
}

TEST(View, UpIsUp) {
  for (const char* name : {"front", "back", "left", "right"}) {
    EXPECT_LT((View::of(name).frame().col(1) - Vec3::UnitZ()).norm(), 1e-12) << name;
  }
  for (const auto& [up, axis] : std::map<std::string, Vec3>{{"x", Vec3::UnitX()},
                                                            {"y", Vec3::UnitY()},
                                                            {"-x", -Vec3::UnitX()},
                                                            {"-y", -Vec3::UnitY()},
                                                            {"-z", -Vec3::UnitZ()}}) {
    EXPECT_LT((View::of("front", up).frame().col(1) - axis).norm(), 1e-12) << up;
    EXPECT_LT((View::of("top", up).frame().col(2) - axis).norm(), 1e-12) << up;
    for (const char* view : {"front", "iso", "-40,70"}) {  // never mirrored
      const Mat3 frame = View::of(view, up).frame();
      EXPECT_LT((frame.transpose() * frame - Mat3::Identity()).norm(), 1e-12);
      EXPECT_NEAR(frame.determinant(), 1, 1e-12);
    }
  }
}

TEST(View, WhatIsNoViewIsRefused) {
  for (const char* text : {"", "above", "30", "30,", ",20", "30,91", "400,0", "30,20,1", "nan,0"}) {
    EXPECT_THROW(View::of(text), UsageError) << text;
  }
  for (const char* up : {"", "w", "+z", "zz", "--z"}) {
    EXPECT_THROW(View::of("front", up), UsageError) << up;
  }
}

TEST(Camera, TheSurfaceTouchesTheAreaAndStaysInside) {
  const test::OwnMesh box = test::box({1, -2, 3}, {4, 8, 5});
  const Rectangle area{10, 20, 300, 200};
  for (const char* name : {"front", "right", "top", "iso", "17,-33"}) {
    const Camera camera(View::of(name), box.view(), area);
    Eigen::AlignedBox2d seen;
    for (Index v = 0; v < box.view().vertices(); ++v) {
      seen.extend(Eigen::Vector2d(camera(box.view().positions[v]).head<2>()));
    }
    EXPECT_GE(seen.min()[0], area.left - 1e-9);
    EXPECT_GE(seen.min()[1], area.top - 1e-9);
    EXPECT_LE(seen.max()[0], area.left + area.width + 1e-9);
    EXPECT_LE(seen.max()[1], area.top + area.height + 1e-9);
    const bool fills = std::abs(seen.sizes()[0] - area.width) < 1e-9 ||
                       std::abs(seen.sizes()[1] - area.height) < 1e-9;
    EXPECT_TRUE(fills) << name;
  }
}

}  // namespace
}  // namespace dsc::render
