// Isolines, arrows and the key: where they are, how wide, how many.
#include "libdsc/base/error.h"
#include "libdsc/render/color.h"
#include "libdsc/render/glyphs.h"
#include "libdsc/render/isolines.h"
#include "libdsc/render/picture.h"
#include "tests/render/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dsc::render {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

TEST(Isolines, ValuesApproachALevelFromTheFasterSide) {
  EXPECT_DOUBLE_EQ(approach(1, 2, 3, 2.2), 1);
  EXPECT_DOUBLE_EQ(approach(1, 2, 3, 1.9), 1);
  EXPECT_DOUBLE_EQ(approach(1, 2, 42, 2.2), 40);  // a step up to the right leads there
  EXPECT_DOUBLE_EQ(approach(1, 2, 42, 1.9), 1);   // and not there
  EXPECT_DOUBLE_EQ(approach(kNone, 2, 5, 2.2), 3);
  EXPECT_DOUBLE_EQ(approach(kNone, 2, 5, 1.8), 0);
  EXPECT_DOUBLE_EQ(approach(kNone, 2, kNone, 2.2), 0);
}

TEST(Isolines, CoverageFallsFromTheLineOutwards) {
  const auto across = [](double here, double slope) {
    return line_coverage({here, here - slope, here + slope, here, here}, 1, 2, 0.5);
  };
  const auto along = [](double here, double slope) {
    return line_coverage({here, here, here, here - slope, here + slope}, 1, 2, 0.5);
  };
  EXPECT_EQ(across(3., 0.1), 1);             // on the line
  EXPECT_NEAR(across(3.1, 0.1), 0.5, 1e-9);  // a pixel away: its edge
  EXPECT_NEAR(across(2.9, 0.1), 0.5, 1e-9);  // on either side
  EXPECT_NEAR(along(3.1, -0.1), 0.5, 1e-9);  // whatever the direction
  EXPECT_EQ(across(3.2, 0.1), 0);
  EXPECT_EQ(across(3., 0.), 0);  // flat: no line anywhere
  EXPECT_EQ(line_coverage({3., kNone, kNone, kNone, kNone}, 1, 2, 0.5), 0);
  // A step from 2.8 to 3.2 between two pixels: both are half a pixel from where 3 is passed.
  EXPECT_NEAR(line_coverage({2.8, 2.8, 3.2, 2.8, 2.8}, 1, 1, 1), 0.5, 1e-9);
  EXPECT_NEAR(line_coverage({3.2, 2.8, 3.2, 3.2, 3.2}, 1, 1, 1), 0.5, 1e-9);
}

/// 400 pixels across, 10 of them margin on each side.
PictureOptions plain_lines(int isolines) {
  PictureOptions options;
  options.width = options.height = 400;
  options.view = View::of("front");
  options.key = false;
  options.ambient = 1;
  options.margin = 0.025;
  options.isolines = isolines;
  return options;
}

/// How much line there is along a row, from the same picture without lines: 0 to 1.
std::vector<double> line_profile(const Image& with, const Image& without, int row) {
  std::vector<double> profile;
  for (int x = 0; x < with.width; ++x) {
    const double a = rgb_of(with.at(x, row)).sum(), b = rgb_of(without.at(x, row)).sum();
    constexpr double kLine = 0.85, kInk = 0.035;  // how much of the line shows, and its own light
    profile.push_back((b - a) / (kLine * (b - kInk)));
  }
  return profile;
}

TEST(Isolines, RunWhereTheValueIsAMultipleAndAreEquallyWide) {
  const test::OwnMesh plane = test::front_plane(1, 1, 64);
  // Of a slope that grows fourfold along x: 0 to 10.
  const Eigen::VectorXd phi =
      plane.positions.row(0).transpose().unaryExpr([](double x) { return 4 * x + 6 * x * x; });
  const Field field = scalar_field("phi", FieldOn::vertex, phi);
  const Picture lined = draw(plane.view(), field, plain_lines(10));
  const Picture bare = draw(plane.view(), field, plain_lines(0));
  EXPECT_EQ(lined.isoline_step, 1);
  EXPECT_EQ(bare.isoline_step, 0);
  const std::vector<double> profile = line_profile(lined.image, bare.image, 200);
  double widest = 0, narrowest = 1e9, all = 0;
  for (int k = 1; k < 10; ++k) {
    const double x = (-4 + std::sqrt(16 + 24. * k)) / 12;  // 4x + 6x² = k
    const double place = 10 + 380 * x;
    double mass = 0, centre = 0;
    for (int i = static_cast<int>(place) - 4; i <= static_cast<int>(place) + 4; ++i) {
      mass += profile[static_cast<std::size_t>(i)];
      centre += profile[static_cast<std::size_t>(i)] * (i + 0.5);
    }
    EXPECT_NEAR(centre / mass, place, 0.25) << k;
    widest = std::max(widest, mass);
    narrowest = std::min(narrowest, mass);
    all += mass;
  }
  EXPECT_LT(widest, 1.15 * narrowest);
  double sum = 0;
  for (const double part : profile) sum += part;
  EXPECT_NEAR(sum, all, 1.5);  // but for the lines of the ends, 0 and 10, there are no others
}

/// Steps of height 1 that rise towards the viewer: `treads` quads deep and `width` wide, their
/// risers unseen from the front. phi is the way over them, and a fifth of x.
test::OwnMesh stairs(int steps, int treads, int width, Eigen::VectorXd& phi) {
  test::OwnMesh mesh;
  const int rows = steps * (treads + 1) + 1;
  mesh.positions.resize(3, rows * (width + 1));
  phi.resize(rows * (width + 1));
  for (int j = 0; j < rows; ++j) {
    const int step = j / (treads + 1), along = j % (treads + 1);
    for (int i = 0; i <= width; ++i) {
      mesh.positions.col(j * (width + 1) + i) << i, -(step * treads + along), step;
      phi[j * (width + 1) + i] = j + 0.2 * i;
    }
  }
  for (int j = 0; j + 1 < rows; ++j) {
    for (int i = 0; i < width; ++i) {
      const int v = j * (width + 1) + i;
      mesh.corners.insert(mesh.corners.end(), {v, v + 1, v + width + 2, v + width + 1});
    }
  }
  return mesh;
}

TEST(Isolines, DoNotBreakWhereStepsHideThem) {
  // From this elevation a step hides 1 / tan 20° = 2.7 of 6 quads and its riser.
  constexpr int kWidth = 16, kStep = 5;
  Eigen::VectorXd phi;
  const test::OwnMesh mesh = stairs(8, 6, kWidth, phi);
  const Field field = scalar_field("phi", FieldOn::vertex, phi);
  PictureOptions options = plain_lines(12);
  options.view = View::of("0,20");
  options.range = {{0., 60.}};
  const Picture lined = draw(mesh.view(), field, options);
  ASSERT_EQ(lined.isoline_step, kStep);
  options.isolines = 0;
  const Image bare = draw(mesh.view(), field, options).image;
  const Camera camera(options.view, mesh.view(), {10, 10, 380, 380});
  int columns = 0;
  for (double x = 0.5; x < kWidth; x += 0.1) {
    const auto column = static_cast<int>(camera(Vec3(x, 0, 0))[0]);
    // The top and the bottom of the picture, where a line may be half, are not looked at.
    const double low = 0.2 * x, high = low + 56;
    if (std::abs(std::remainder(low, kStep)) < 1 || std::abs(std::remainder(high, kStep)) < 1)
      continue;
    ++columns;
    int lines = 0;
    bool inside = false;
    for (int y = 0; y < bare.height; ++y) {
      const double ratio =
          rgb_of(lined.image.at(column, y)).sum() / rgb_of(bare.at(column, y)).sum();
      if ((ratio < 0.8) != inside) lines += (inside = !inside) ? 1 : 0;
    }
    EXPECT_EQ(lines, std::floor(high / kStep) - std::floor(low / kStep)) << "x = " << x;
  }
  EXPECT_GT(columns, 30);
}

TEST(Isolines, DoNotOutlineWhatLiesBefore) {
  // Before a plane of value 0.25 to 0.75, a smaller one of the same values: no multiple of 1 lies
  // between, but at the edges the values jump.
  test::OwnMesh two = test::front_plane(1, 1, 2);
  const Index n = two.positions.cols();
  Eigen::Matrix3Xd both(3, 2 * n);
  both << two.positions, (0.5 * two.positions).colwise() + Vec3(0.25, -1, 0.25);
  two.positions = both;
  const std::vector<VertexId> first = two.corners;
  for (const VertexId v : first) two.corners.push_back(static_cast<VertexId>(v + n));
  Eigen::VectorXd phi(2 * n);
  phi.head(n) = 0.25 + 0.5 * two.positions.row(0).head(n).array().transpose();
  phi.tail(n) = phi.head(n).array() + 10.;
  const Field field = scalar_field("phi", FieldOn::vertex, phi);
  PictureOptions options = plain_lines(11);
  options.range = {{0., 11.}};
  const Image lined = draw(two.view(), field, options).image;
  options.isolines = 0;
  EXPECT_EQ(lined, draw(two.view(), field, options).image);
}

TEST(Arrows, AreAsManyAsAskedForAndPointAlongTheVectors) {
  const test::OwnMesh plane = test::front_plane(1, 1, 4);
  Eigen::Matrix3Xd v(3, 16);
  v.colwise() = Vec3(1, 0, 2);  // up, and a little to the right
  const Field field = vector_field("v", {"vx", "vy", "vz"}, FieldOn::face, {v.data(), 16});
  const Rectangle area{10, 10, 380, 380};
  const Camera camera(View::of("front"), plane.view(), area);
  const Tracer tracer(plane.view(), camera, {});
  for (const int count : {1, 10, 200}) {
    const ArrowMesh arrows =
        make_arrows(plane.view(), field, count, tracer, camera, area, Context{});
    const Index vertices = static_cast<Index>(arrows.positions.size() / 3);
    constexpr Index kOne = 3 * 12 + 2;  // three rings, the tail's middle, the tip
    ASSERT_EQ(vertices % kOne, 0);
    EXPECT_NEAR(static_cast<double>(vertices / kOne), count, 1 + 0.25 * count);
    const Vec3View points = arrows.view().positions;
    for (Index a = 0; a < vertices / kOne; ++a) {
      const Vec3 along = points[a * kOne + kOne - 1] - points[a * kOne + kOne - 2];
      EXPECT_LT((along.normalized() - Vec3(1, -2, 0).normalized()).norm(), 1e-9);  // rows run down
    }
  }
}

TEST(Arrows, AreDrawnBeforeTheSurface) {
  const test::OwnMesh plane = test::front_plane(1, 1, 1);
  Eigen::Matrix3Xd v(3, 1);
  v << 0, -3, 0;  // towards the viewer
  const Field field = vector_field("v", {"vx", "vy", "vz"}, FieldOn::face, {v.data(), 1});
  PictureOptions options = plain_lines(0);
  const auto dark = [&] {  // of arrows: the surface is in the middle of the map
    const Image image = draw(plane.view(), field, options).image;
    return std::count_if(image.pixels.begin(), image.pixels.end(),
                         [](const Pixel& p) { return lab_of(rgb_of(p))[0] < 0.5; });
  };
  EXPECT_EQ(dark(), 0);
  options.glyphs = 25;
  const auto before = dark();
  EXPECT_GT(before, 25 * 20);
  EXPECT_LT(before, 400 * 400 / 4);
  // Away from the viewer, the surface hides them but for their tails.
  v << 0, 3, 0;
  EXPECT_LT(dark(), before);
}

TEST(Key, TheBarHasTheColoursInOrderAndThePictureTheRest) {
  const test::OwnMesh plane = test::front_plane(1, 1, 4);
  const Eigen::VectorXd phi = plane.positions.row(2).transpose();
  PictureOptions options;
  options.width = 400;
  options.height = 300;
  options.view = View::of("front");
  options.isolines = 0;
  const Picture picture = draw(plane.view(), scalar_field("phi", FieldOn::vertex, phi), options);
  EXPECT_EQ(picture.title, "phi");
  // The bar is the last coloured thing to the right: find a column of it, and walk down.
  const auto coloured = [&](int x, int y) {
    const Pixel& p = picture.image.at(x, y);
    return std::max({p[0], p[1], p[2]}) - std::min({p[0], p[1], p[2]}) > 40;
  };
  int column = options.width - 1;
  while (column > 0 && !coloured(column, 150)) --column;
  --column;  // off its edge
  double last = 2;
  int rows = 0;
  for (int y = 0; y < options.height; ++y) {
    if (!coloured(column, y)) continue;
    const double light = lab_of(rgb_of(picture.image.at(column, y)))[0];
    EXPECT_LT(light, last + 1e-2);  // high values, which are light, are above
    last = light;
    ++rows;
  }
  EXPECT_NEAR(rows, 0.6 * (300 - 2 * 0.045 * 300), 12);
  EXPECT_LT(last, 0.42);
}

}  // namespace
}  // namespace dsc::render
