// Pages in a browser: what they draw and read out, against the surface that was written.
#include "tests/page/browser.h"
#include "libdsc/normals/radius.h"
#include "libdsc/normals/surface_normals.h"
#include "libdsc/page/page.h"
#include "libdsc/render/colormap.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/shapes.h"
#include "tests/io/temporary_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace dsc {
namespace {

using nlohmann::json;

constexpr double kH = 0.05;

Vec3 vec3(const json& j) { return {j[0].get<double>(), j[1].get<double>(), j[2].get<double>()}; }

/// Every channel within `tolerance`.
void expect_color(const json& seen, const render::Pixel& expected, int tolerance) {
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(seen[c].get<int>(), expected[c], tolerance) << "channel " << c << " of " << seen;
  }
}

render::Pixel color_of(const char* map, double t) {
  return render::pixel_of(render::Colormap(map)(t));
}

double slope(const Vec3& p) { return p.dot(Vec3(1., 2., 3.)); }

/// Voxels of the unit sphere with a function that is linear in space, so that it is known wherever
/// the surface is drawn, a second one beside it, and one of the faces.
class SpherePage : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!test::has_browser()) GTEST_SKIP() << test::kNoBrowser;
    const BinaryVolume voxels = digitize(Sphere(1.), {kH, kH, kH});
    surface = extract_surface(voxels);
    integral_invariant_normals(surface, voxels, {.radius = shape_radius(kH)});
    const FlatMesh mesh = surface.flat();
    up.resize(mesh.vertices());
    for (Index v = 0; v < up.size(); ++v) up[v] = 10. + slope(mesh.positions[v]);
    up_naive = 2. * up;
    numbers = Eigen::VectorXd::LinSpaced(mesh.faces(), 0.5, 99.);
    write_page(path(), {mesh,
                        {scalar_field("up", FieldOn::vertex, up),
                         scalar_field("up_naive", FieldOn::vertex, up_naive),
                         scalar_field("numbers", FieldOn::face, numbers)}});
  }
  std::string path() const { return folder / "sphere.html"; }
  /// What the page says as it comes, asked once: a browser takes seconds to start.
  const json& as_it_comes() const {
    static const json page = test::self_test(path());
    return page;
  }

  const TemporaryFolder folder;
  DigitalSurface surface;
  Eigen::VectorXd up, up_naive, numbers;
};

TEST_F(SpherePage, LoadsWithoutAnError) {
  const json& page = as_it_comes();
  EXPECT_EQ(page["errors"], json::array());
  EXPECT_EQ(page["glError"], 0);
  EXPECT_EQ(page["faces"], surface.face_count());
  EXPECT_EQ(page["panes"].size(), 2U) << "the naive field stands beside the other";
}

TEST_F(SpherePage, ReadsTheVertexAndTheFaceUnderThePointer) {
  const FlatMesh mesh = surface.flat();
  const json& page = as_it_comes();
  const Vec3 eye = vec3(page["eye"]);
  for (const json& pane : page["panes"]) {
    const json& picked = pane["picked"];
    const Vec3 point = vec3(picked["point"]);
    EXPECT_LT((point - eye).norm(), 3. * kH)
        << "the middle of the view is the sphere's nearest point";
    const auto v = picked["vertex"].get<VertexId>();
    const auto f = picked["face"].get<Index>();
    const auto corners = mesh.face(f);
    EXPECT_NE(std::find(corners.begin(), corners.end(), v), corners.end());
    for (const VertexId w : corners) {  // of the face's corners the nearest
      EXPECT_LE((mesh.positions[v] - point).norm(), (mesh.positions[w] - point).norm() + 1e-6);
    }
    // The point lies on the face: in its plane and within its square.
    const Vec3 normal = mesh.surfels[static_cast<std::size_t>(f)].normal();
    EXPECT_NEAR(normal.dot(point - mesh.positions[corners[0]]), 0., 1e-6);
    EXPECT_LE((point - 0.5 * (mesh.positions[corners[0]] + mesh.positions[corners[2]]))
                  .cwiseAbs()
                  .maxCoeff(),
              0.5 * kH + 1e-6);
    EXPECT_LT((vec3(picked["position"]) - mesh.positions[v]).norm(), 1e-9 * kH * 3);
    EXPECT_NEAR(picked["values"]["up"].get<double>(), up[v], 1e-6 * up[v]);
    EXPECT_NEAR(picked["values"]["up_naive"].get<double>(), up_naive[v], 1e-6 * up_naive[v]);
    EXPECT_NEAR(picked["values"]["numbers"].get<double>(), numbers[f], 1e-5);
    EXPECT_EQ(pane["reading"][0], json({"vertex", std::to_string(v)}));
    EXPECT_EQ(pane["reading"][6], json({"face", std::to_string(f)}));
    EXPECT_NEAR(std::stod(pane["reading"][4][1].get<std::string>()), up[v], 1e-6 * up[v]);
    EXPECT_LT(pane["pickMilliseconds"].get<double>(), 200.);
  }
}

TEST_F(SpherePage, DrawsTheFieldInItsColours) {
  // Each pane its own range: in both, the middle shows the value there.
  const json page = test::self_test(path(), "share=off&isolines=0&map=ember");
  for (int i = 0; i < 2; ++i) {
    const json& pane = page["panes"][static_cast<std::size_t>(i)];
    const double value = 10. + slope(vec3(pane["picked"]["point"]));
    const double t = (value - up.minCoeff()) / (up.maxCoeff() - up.minCoeff());
    expect_color(pane["colours"]["none"], color_of("ember", t), 2);
    // Estimated normals at the middle look at the eye, and light from there changes no colour.
    expect_color(pane["colours"]["estimated"], color_of("ember", t), 6);
  }
}

TEST_F(SpherePage, OneRangeForBothIsThatOfBoth) {
  const json page = test::self_test(path(), "share=on&isolines=0&map=lagoon");
  const double low = up.minCoeff(), high = up_naive.maxCoeff();
  for (int i = 0; i < 2; ++i) {
    const json& pane = page["panes"][static_cast<std::size_t>(i)];
    const double value = (1. + i) * (10. + slope(vec3(pane["picked"]["point"])));
    expect_color(pane["colours"]["none"], color_of("lagoon", (value - low) / (high - low)), 2);
  }
}

TEST_F(SpherePage, ShadesByTheFacesOwnNormalsToo) {
  const json page = test::self_test(path(), "beside=nothing&isolines=0");
  ASSERT_EQ(page["panes"].size(), 1U);
  const json& pane = page["panes"][0];
  const auto f = pane["picked"]["face"].get<std::size_t>();
  const double facing = surface.surfels()[f].normal().dot(vec3(page["eye"]));
  ASSERT_LT(facing, 0.95) << "the face is seen at an angle";
  // It is darker than its colour, the estimated normal's shade is not.
  const auto light = [&](const char* shading) {
    int sum = 0;
    for (const json& channel : pane["colours"][shading]) sum += channel.get<int>();
    return sum;
  };
  EXPECT_LT(light("faces"), 0.97 * light("none"));
  EXPECT_GT(light("estimated"), 0.97 * light("none"));
}

TEST_F(SpherePage, ACutShowsAndReadsWhatIsBehindIt) {
  const Vec3 eye = vec3(as_it_comes()["eye"]);
  // Everything on the near side of y = 0 is cut away; the inside of the far side comes to light.
  ASSERT_LT(eye[1], -0.5);
  const json page = test::self_test(path(), "beside=nothing&clip=y&place=0&flip=on&isolines=0");
  const json& pane = page["panes"][0];
  const Vec3 point = vec3(pane["picked"]["point"]);
  EXPECT_LT((point + eye).norm(), 3. * kH);
  const double t = (10. + slope(point) - up.minCoeff()) / (up.maxCoeff() - up.minCoeff());
  expect_color(pane["colours"]["none"], color_of("lagoon", t), 2);
}

TEST_F(SpherePage, IsolinesLieAtTheMultiplesOfTheirStep) {
  const Vec3 middle = vec3(as_it_comes()["panes"][0]["picked"]["point"]);
  // About 60 lines for a range of 7.5 are 0.2 apart. The middle of the view is on a line, or
  // halfway between two.
  for (const double there : {0., 0.1}) {
    const FlatMesh mesh = surface.flat();
    for (Index v = 0; v < up.size(); ++v) up[v] = there + slope(mesh.positions[v] - middle);
    write_page(path(), {mesh, {scalar_field("up", FieldOn::vertex, up)}});
    const json page = test::self_test(path(), "isolines=60&map=lagoon");
    const double low = up.minCoeff(), high = up.maxCoeff();
    render::Pixel expected = color_of("lagoon", (there - low) / (high - low));
    if (there == 0.) {  // black of this strength lies over the colour
      for (auto& channel : expected) channel = static_cast<std::uint8_t>(channel * (1. - 0.55));
    }
    expect_color(page["panes"][0]["colours"]["none"], expected, 3);
  }
}

TEST_F(SpherePage, IsLightOrDark) {
  expect_color(as_it_comes()["background"], {0xf4, 0xf3, 0xf0}, 0);
  expect_color(test::self_test(path(), "theme=dark")["background"], {0x17, 0x18, 0x1a}, 0);
}

/// Polygons around the middle of the first view, which looks at them from in front and above.
class PolygonPage : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!test::has_browser()) GTEST_SKIP() << test::kNoBrowser;
    // A hexagon in the plane y = 0, and a fan of three triangles on one of its edges, so that four
    // faces meet there.
    constexpr double kPi = 3.14159265358979323846;
    for (int i = 0; i < 6; ++i)
      points.push_back({std::cos(i * kPi / 3), 0., std::sin(i * kPi / 3)});
    corners = {0, 1, 2, 3, 4, 5};
    offsets = {0, 6};
    for (const double y : {-0.5, 0., 0.5}) {
      corners.insert(corners.end(), {4, 5, static_cast<VertexId>(points.size())});
      points.push_back({0., y, -1.});
      offsets.push_back(static_cast<Index>(corners.size()));
    }
    points.push_back({0., 0., 1.});  // the middle of the box is the hexagon's
    corners.insert(corners.end(), {1, 2, 9});
    offsets.push_back(static_cast<Index>(corners.size()));
  }
  json open(const Field& field) {
    Result result;
    result.mesh.positions = {points[0].data(), static_cast<Index>(points.size())};
    result.mesh.corners = corners;
    result.mesh.offsets = offsets;
    result.fields = {field};
    write_page(folder / "polygons.html", result);
    json page = test::self_test(folder / "polygons.html", "isolines=0");
    EXPECT_EQ(page["errors"], json::array());
    EXPECT_EQ(page["panes"][0]["picked"]["face"], 0);
    EXPECT_LT(vec3(page["panes"][0]["picked"]["point"]).norm(), 0.01);
    return page["panes"][0];
  }

  const TemporaryFolder folder;
  std::vector<Vec3> points;
  std::vector<VertexId> corners;
  std::vector<Index> offsets;
};

TEST_F(PolygonPage, FacesWithInfiniteVerticesAreGrey) {
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<double> distance{0, 1, inf, 2, 1, 3, 4, 5, 6, 7};
  const json pane = open(scalar_field("distance", FieldOn::vertex, distance));
  expect_color(pane["colours"]["none"], {140, 140, 140}, 1);
}

TEST_F(PolygonPage, InfinityIsReadAsSuch) {
  const std::vector<double> all(10, std::numeric_limits<double>::infinity());
  const json pane = open(scalar_field("distance", FieldOn::vertex, all));
  EXPECT_EQ(pane["reading"][4], json({"distance", "∞"}));
  expect_color(pane["colours"]["none"], {140, 140, 140}, 1);
}

TEST_F(PolygonPage, SignedValuesOfFacesTakeADivergingMapAround0) {
  const std::vector<double> bend{-1., 2., 1., 0., 3.};
  const json pane = open(scalar_field("bend", FieldOn::face, bend));
  expect_color(pane["colours"]["none"], color_of("polar", (-1. + 3.) / 6.), 2);
}

TEST_F(PolygonPage, LabelsDifferInHue) {
  const std::vector<double> one{7., 3., 3., 1., 3.}, other{1., 3., 7., 7., 3.};
  const json a = open(scalar_field("label", FieldOn::face, one));
  const json b = open(scalar_field("label", FieldOn::face, other));
  int difference = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    difference += std::abs(a["colours"]["none"][c].get<int>() - b["colours"]["none"][c].get<int>());
  }
  EXPECT_GT(difference, 60);
  EXPECT_EQ(a["picked"]["values"]["label"], 7.);
}

TEST_F(PolygonPage, HugeAndTinyValuesAreReadInTheirSize) {
  std::vector<double> huge, tiny;
  for (int i = 0; i < 10; ++i) {
    huge.push_back((1. + i) * 1e306);
    tiny.push_back((1. + i) * 1e-306);
  }
  for (const auto& values : {huge, tiny}) {
    const json pane = open(scalar_field("heat", FieldOn::vertex, values));
    const auto v = pane["picked"]["vertex"].get<std::size_t>();
    EXPECT_NEAR(pane["picked"]["values"]["heat"].get<double>() / values[v], 1., 1e-6);
  }
}

}  // namespace
}  // namespace dsc
