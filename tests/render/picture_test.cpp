// Pictures against what is known of them: areas, colours at points, which side is seen.
#include "libdsc/render/picture.h"

#include "libdsc/base/error.h"
#include "libdsc/render/colormap.h"
#include "libdsc/render/lighting.h"
#include "libdsc/render/paint.h"
#include "tests/render/meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace dsc::render {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A square picture without key, lit from everywhere.
PictureOptions bare(int size, const std::string& view = "front") {
  PictureOptions options;
  options.width = options.height = size;
  options.view = View::of(view);
  options.key = false;
  options.ambient = 1;
  options.isolines = 0;
  options.margin = 0.1;
  return options;
}

/// Equal up to the rounding of a byte.
void expect_near(const Pixel& a, const Pixel& b) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1);
}

/// The area of a picture that is covered by what has one colour, in pixels.
double covered(const Image& image, const Rgb& colour) {
  double area = 0;
  for (const Pixel& pixel : image.pixels) area += (1 - rgb_of(pixel)[0]) / (1 - colour[0]);
  return area;
}

TEST(Picture, TheSilhouetteOfASphereIsADisk) {
  const test::OwnMesh ball = test::sphere(128);
  for (const char* view : {"front", "top", "iso", "12,34"}) {
    const Picture picture = draw(ball.view(), bare(400, view));
    const Rgb colour = rgb_of(picture.image.at(200, 200));
    const double r = 160;  // 400 pixels less two margins of 40
    EXPECT_NEAR(covered(picture.image, colour) / (std::numbers::pi * r * r), 1, 0.004) << view;
  }
}

TEST(Picture, FansCoverPolygonsAsQuadsDo) {
  // The same square as one quad, and as a hexagon with two straight corners beside a triangle that
  // is a point of view's edge: the area is the same.
  test::OwnMesh square = test::front_plane(1, 1, 1);
  test::OwnMesh hexagon;
  hexagon.positions.resize(3, 6);
  hexagon.positions << 0, 0.5, 1, 1, 0.5, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1;
  hexagon.corners = {0, 1, 2, 3, 4, 5};
  hexagon.offsets = {0, 6};
  const Image a = draw(square.view(), bare(100)).image, b = draw(hexagon.view(), bare(100)).image;
  EXPECT_EQ(a, b);
  EXPECT_NEAR(covered(a, rgb_of(a.at(50, 50))), 80 * 80, 8);
}

TEST(Picture, APointHasTheColourOfItsValue) {
  const test::OwnMesh plane = test::front_plane(2, 2, 4);
  const Eigen::VectorXd phi = plane.positions.row(0).transpose() * 3.;  // 0 to 6
  PictureOptions options = bare(100);
  const Field field = scalar_field("phi", FieldOn::vertex, phi);
  for (const char* name : {"lagoon", "ember", "grey"}) {
    options.colormap = name;
    const Image image = draw(plane.view(), field, options).image;
    const Colormap map(name);
    for (const int x : {12, 30, 50, 77, 88}) {
      expect_near(image.at(x, 50), pixel_of(map((x + 0.5 - 10) / 80)));
    }
  }
  // A range of its own, and values beyond it.
  options.range = {{1.5, 4.5}};
  const Image image = draw(plane.view(), field, options).image;
  const Colormap map("grey");
  expect_near(image.at(15, 40), pixel_of(map(0)));
  expect_near(image.at(49, 40), pixel_of(map((6 * 39.5 / 80 - 1.5) / 3)));
  expect_near(image.at(85, 40), pixel_of(map(1)));
}

TEST(Picture, FieldsOfFacesAreConstantOnThem) {
  const test::OwnMesh plane = test::front_plane(1, 1, 2);
  const Eigen::Vector4d values(0, 1, 2, 3);  // bottom left, bottom right, top left, top right
  PictureOptions options = bare(100);
  const Picture picture =
      draw(plane.view(), scalar_field("c", FieldOn::face, Eigen::VectorXd(values)), options);
  const Colormap map("lagoon");
  expect_near(picture.image.at(20, 80), pixel_of(map(0)));
  expect_near(picture.image.at(80, 60), pixel_of(map(1. / 3)));
  expect_near(picture.image.at(40, 20), pixel_of(map(2. / 3)));
  expect_near(picture.image.at(60, 40), pixel_of(map(1)));
  EXPECT_EQ(picture.isoline_step, 0);
}

TEST(Picture, TheSideTowardsTheViewerIsSeen) {
  const test::OwnMesh box = test::box({0, 0, 0}, {1, 1, 1});
  Eigen::VectorXd side(6);
  side << 0, 1, 2, 3, 4, 5;
  const Field field = scalar_field("side", FieldOn::face, side);
  const Colormap map("lagoon");
  const std::pair<const char*, double> views[] = {{"left", 0}, {"right", 1},  {"front", 2},
                                                  {"back", 3}, {"bottom", 4}, {"top", 5}};
  for (const auto& [view, value] : views) {
    const Image image = draw(box.view(), field, bare(60, view)).image;
    for (const int x : {8, 30, 51}) expect_near(image.at(x, 30), pixel_of(map(value / 5)));
  }
}

TEST(Picture, RightIsRightAndUpIsUp) {
  const test::OwnMesh plane = test::front_plane(1, 1, 8);
  const Colormap map("lagoon");
  for (const int axis : {0, 2}) {
    const Eigen::VectorXd along = plane.positions.row(axis).transpose();
    const Image image =
        draw(plane.view(), scalar_field("c", FieldOn::vertex, along), bare(100)).image;
    expect_near(image.at(axis == 0 ? 88 : 50, axis == 0 ? 50 : 11), pixel_of(map(78.5 / 80)));
    expect_near(image.at(axis == 0 ? 11 : 50, axis == 0 ? 50 : 88), pixel_of(map(1.5 / 80)));
  }
  // From behind, x runs to the left.
  const Eigen::VectorXd x = plane.positions.row(0).transpose();
  const Image behind =
      draw(plane.view(), scalar_field("c", FieldOn::vertex, x), bare(100, "back")).image;
  expect_near(behind.at(11, 50), pixel_of(map(78.5 / 80)));
}

TEST(Picture, TheNearerFaceHidesTheOther) {
  test::OwnMesh two = test::front_plane(1, 1, 1);
  Eigen::Matrix3Xd both(3, 8);
  both << two.positions, two.positions.colwise() + Vec3(0, 0.25, 0);
  two.positions = both;
  two.corners = {4, 5, 7, 6, 0, 1, 3, 2};  // the far one first
  const Eigen::VectorXd values = Eigen::Vector2d(0, 1);
  const Field field = scalar_field("c", FieldOn::face, values);
  const Colormap map("lagoon");
  expect_near(draw(two.view(), field, bare(50)).image.at(25, 25), pixel_of(map(1)));
  expect_near(draw(two.view(), field, bare(50, "back")).image.at(25, 25), pixel_of(map(0)));
  // At the same place to the last bit, the lower number is seen, whatever the view.
  for (const auto& corners : {std::vector<VertexId>{0, 1, 3, 2, 0, 1, 3, 2},
                              std::vector<VertexId>{0, 1, 3, 2, 2, 3, 1, 0}}) {
    two.corners = corners;
    const Image image = draw(two.view(), field, bare(50)).image;
    for (int y = 6; y < 44; ++y) {
      for (int x = 6; x < 44; ++x) expect_near(image.at(x, y), pixel_of(map(0)));
    }
  }
}

TEST(Picture, FlatLightFallsOnFacesAndTrueLightOnNormals) {
  const test::OwnMesh box = test::box({0, 0, 0}, {1, 1, 1});
  PictureOptions options = bare(60);
  const Rgb colour = rgb_of(draw(box.view(), options).image.at(30, 30));
  options.ambient = 0.3;
  const Lighting lighting{0.3};
  // From the front, the normal of the face towards the viewer.
  expect_near(draw(box.view(), options).image.at(30, 30),
              pixel_of(colour * lighting(Vec3::UnitZ())));
  // From the front, the world's (x, y, z) is (right, away, up).
  Eigen::Matrix3Xd u(3, 6);
  u.colwise() = Vec3(0.6, -0.64, 0.48);
  FlatMesh mesh = box.view();
  mesh.normals = {u.data(), 6};
  const Pixel lit = pixel_of(colour * lighting(Vec3(0.6, 0.48, 0.64)));
  expect_near(draw(mesh, options).image.at(30, 30), lit);
  options.shading = Shading::true_normals;
  expect_near(draw(mesh, options).image.at(30, 30), lit);
  EXPECT_THROW(draw(box.view(), options), UsageError);
  options.shading = Shading::flat;
  expect_near(draw(mesh, options).image.at(30, 30), pixel_of(colour * lighting(Vec3::UnitZ())));
}

TEST(Picture, InfiniteValuesAreGreyAndCounted) {
  const test::OwnMesh plane = test::front_plane(2, 1, 2);
  Eigen::VectorXd phi = plane.positions.row(0).transpose();
  for (Index v = 0; v < phi.size(); ++v) {
    if (phi[v] == 2) phi[v] = kInfinity;  // the right half has it at a corner
  }
  PictureOptions options = bare(100);
  const Picture picture = draw(plane.view(), scalar_field("c", FieldOn::vertex, phi), options);
  EXPECT_EQ(picture.missing, 3);
  EXPECT_EQ(picture.high, 1);  // of the finite ones
  EXPECT_EQ(picture.image.at(70, 50), pixel_of(missing_colour()));
  expect_near(picture.image.at(30, 50), pixel_of(Colormap("lagoon")(20.5 / 40)));
  phi.setConstant(kInfinity);
  EXPECT_EQ(draw(plane.view(), scalar_field("c", FieldOn::vertex, phi), options).missing, 9);
}

TEST(Picture, SignedValuesHaveZeroInTheMiddle) {
  const test::OwnMesh plane = test::front_plane(3, 3, 3);
  const Eigen::VectorXd phi = plane.positions.row(0).transpose().array() - 1.;  // -1 to 2
  const Picture picture = draw(plane.view(), scalar_field("c", FieldOn::vertex, phi), bare(100));
  EXPECT_EQ(picture.colormap, "polar");
  EXPECT_NEAR(picture.low, -1, 1e-12);  // the bar shows what there is
  EXPECT_NEAR(picture.high, 2, 1e-12);
  const Pixel zero = picture.image.at(36, 50);  // x = 1 lies at 10 + 80 / 3
  expect_near(zero, pixel_of(Colormap("polar")((2 + 26.5 * 3 / 80 - 1) / 4)));
  // So it is in a range of its own, and where the map was asked for.
  PictureOptions options = bare(100);
  options.colormap = "polar";
  options.range = {{-0.5, 1.}};
  const Image image = draw(plane.view(), scalar_field("c", FieldOn::vertex, phi), options).image;
  const Colormap polar("polar");
  expect_near(image.at(36, 50), pixel_of(polar((1 + 26.5 * 3 / 80 - 1) / 2)));
  expect_near(image.at(12, 50), pixel_of(polar(0.25)));
  expect_near(image.at(80, 50), pixel_of(polar(1)));
}

TEST(Picture, LabelsAreThoseBehindTheFaces) {
  const test::OwnMesh box = test::box({0, 0, 0}, {1, 1, 1});
  const std::vector<double> inner(6, 3.), outer = {0, 0, 7, 7, 0, 0};
  PictureOptions options = bare(60);
  const auto seen = [&](const char* view) {
    options.view = View::of(view);
    return draw_labels(box.view(), inner, outer, options).image.at(30, 30);
  };
  EXPECT_EQ(seen("front"), seen("right"));  // 3 lies behind both
  // From inside, the wall to 7 shows 7: the box turned inside out is seen so.
  test::OwnMesh turned = box;
  for (std::size_t f = 0; f < 6; ++f) {
    std::swap(turned.corners[4 * f + 1], turned.corners[4 * f + 3]);
  }
  options.view = View::of("front");
  const Pixel seven = draw_labels(turned.view(), inner, outer, options).image.at(30, 30);
  EXPECT_NE(seven, seen("front"));
  options.view = View::of("right");
  EXPECT_EQ(draw_labels(turned.view(), inner, outer, options).image.at(30, 30), seen("right"));
}

TEST(Picture, WhatCannotBeDrawnIsRefused) {
  test::OwnMesh plane = test::front_plane(1, 1, 1);
  const Eigen::VectorXd four = Eigen::Vector4d(0, 1, 2, 3);
  const Field field = scalar_field("c", FieldOn::vertex, four);
  EXPECT_THROW(draw(FlatMesh{}), InputError);
  Eigen::VectorXd bad = four;
  bad[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(draw(plane.view(), scalar_field("c", FieldOn::vertex, bad)), InputError);
  EXPECT_THROW(draw(plane.view(), scalar_field("c", FieldOn::face, four)), UsageError);
  const auto with = [](auto&& change) {
    PictureOptions options = bare(50);
    change(options);
    return options;
  };
  EXPECT_THROW(draw(plane.view(), field, with([](auto& o) { o.width = 0; })), UsageError);
  EXPECT_THROW(draw(plane.view(), field, with([](auto& o) { o.range = {{2., 2.}}; })), UsageError);
  EXPECT_THROW(draw(plane.view(), field, with([](auto& o) { o.samples = 0; })), UsageError);
  EXPECT_THROW(draw(plane.view(), field, with([](auto& o) { o.colormap = "jet"; })), UsageError);
  EXPECT_THROW(draw(plane.view(), field, with([](auto& o) { o.glyphs = 9; })), UsageError);
  plane.positions(1, 2) = kInfinity;
  EXPECT_THROW(draw(plane.view()), InputError);
  plane.positions(1, 2) = 0;
  plane.corners[0] = 4;
  EXPECT_THROW(draw(plane.view()), InputError);
}

TEST(Picture, NoExtentAtAllIsStillAPicture) {
  test::OwnMesh point = test::front_plane(1, 1, 1);
  point.positions.setZero();
  const Image image = draw(point.view(), bare(32)).image;
  EXPECT_EQ(image.width, 32);
  // Edge-on, a plane is a line.
  EXPECT_EQ(draw(test::front_plane(1, 1, 1).view(), bare(32, "top")).image.height, 32);
}

}  // namespace
}  // namespace dsc::render
