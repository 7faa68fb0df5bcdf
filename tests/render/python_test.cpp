// Pictures and .glb files opened by Python with nothing but json, struct and zlib.
#include "libdsc/render/colormap.h"
#include "libdsc/render/glb_file.h"
#include "libdsc/render/picture.h"
#include "libdsc/render/png_file.h"
#include "tests/io/python_check.h"
#include "tests/io/sample_meshes.h"
#include "tests/render/meshes.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <random>

namespace dsc {
namespace {

#ifdef DSC_PYTHON

/// s.glb of a surface with a field, and truth.json.
void write_glb_and_truth(const TemporaryFolder& folder) {
  const PolygonMesh mesh = test::mixed_mesh();
  std::mt19937_64 random(5);
  std::vector<double> heat;
  for (Index v = 0; v < mesh.positions.cols(); ++v) heat.push_back(test::odd_double(random));
  ASSERT_TRUE(render::write_glb(folder / "s.glb",
                                {mesh.view(), {scalar_field("heat", FieldOn::vertex, heat)}})
                  .empty());
  double largest = 0;
  for (const double value : heat) largest = std::max(largest, std::abs(value));
  const render::Colormap polar("polar");  // values of both signs: 0 is in the middle
  std::vector<long> colours;
  for (const double value : heat) {
    const render::Rgb colour = polar((value + largest) / (2 * largest));
    for (int k = 0; k < 3; ++k) {
      colours.push_back(std::lround(65535. * std::clamp(colour[k], 0., 1.)));
    }
    colours.push_back(65535);
  }
  const double* p = mesh.positions.data();
  write_all(folder / "truth.json",
            "{\"positions\":" + test::json_list(std::vector<double>(p, p + mesh.positions.size())) +
                ",\"faces\":" + test::json_faces(mesh.view()) + ",\"scalar\":" +
                test::json_list(heat) + ",\"colours\":" + test::json_integers(colours) + "}");
}

TEST(GlbByPython, HasEveryFloatColourAndTriangle) {
  const TemporaryFolder folder;
  write_glb_and_truth(folder);
  std::string said;
  EXPECT_EQ(test::check_by_python(folder.path(), "glb", &said), 0) << said;
}

/// A bit of each array, and a digit of the translation.
TEST(GlbByPython, SeesAChangedBit) {
  const TemporaryFolder folder;
  write_glb_and_truth(folder);
  ASSERT_EQ(test::check_by_python(folder.path(), "glb"), 0);
  const std::string bytes = read_all(folder / "s.glb");
  const auto expect_seen = [&](std::size_t at, int bits, const std::string& what) {
    std::string changed = bytes, said;
    changed[at] = static_cast<char>(changed[at] ^ bits);
    write_all(folder / "s.glb", changed);
    EXPECT_EQ(test::check_by_python(folder.path(), "glb", &said), 1) << what;
    EXPECT_NE(said.find("glb"), std::string::npos) << said;
  };
  std::uint32_t text = 0;
  std::memcpy(&text, bytes.data() + 12, sizeof text);
  const auto json = nlohmann::json::parse(bytes.substr(20, text));
  ASSERT_EQ(json["bufferViews"].size(), 5U);
  const int normals = json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"].get<int>();
  for (const auto& view : json["bufferViews"]) {
    const std::size_t at = 28 + text + view["byteOffset"].get<std::size_t>();
    // Normals are means, which Python finds to six digits.
    const bool of_normals = &view == &json["bufferViews"][static_cast<std::size_t>(normals)];
    expect_seen(of_normals ? at + 1 : at, of_normals ? 128 : 1, view.dump());
  }
  expect_seen(bytes.find_first_of("123456789", bytes.find("\"translation\":[")), 1, "a digit");
}

/// s.png, and truth.json with its pixels.
void write_png_and_truth(const TemporaryFolder& folder, const render::Image& image) {
  render::write_png(folder / "s.png", image);
  std::string pixels;
  for (const render::Pixel& pixel : image.pixels) {
    for (const std::uint8_t value : pixel) {
      for (const int digit : {value >> 4, value & 15}) pixels += "0123456789abcdef"[digit];
    }
  }
  write_all(folder / "truth.json",
            "{\"picture_size\":" + test::json_integers(std::vector{image.width, image.height}) +
                ",\"pixels\":\"" + pixels + "\"}");
}

render::Image drawn() {
  const test::OwnMesh ball = test::sphere(12);
  const Eigen::VectorXd height = ball.positions.row(2).transpose();
  render::PictureOptions options;
  options.width = 170;
  options.height = 110;
  return render::draw(ball.view(), scalar_field("height", FieldOn::vertex, height), options).image;
}

TEST(PngByPython, HasEveryPixel) {
  const TemporaryFolder folder;
  render::Image noise(31, 17);
  std::mt19937 random(3);
  for (render::Pixel& pixel : noise.pixels) {
    for (std::uint8_t& value : pixel) value = static_cast<std::uint8_t>(random());
  }
  for (const render::Image& image : {drawn(), noise, render::Image(1, 1, {1, 2, 3})}) {
    write_png_and_truth(folder, image);
    std::string said;
    EXPECT_EQ(test::check_by_python(folder.path(), "png", &said), 0) << said;
  }
}

TEST(PngByPython, SeesAChangedBit) {
  const TemporaryFolder folder;
  render::Image image = drawn();
  write_png_and_truth(folder, image);
  ASSERT_EQ(test::check_by_python(folder.path(), "png"), 0);
  const std::string bytes = read_all(folder / "s.png");
  for (const std::size_t at : {std::size_t{3}, std::size_t{19}, bytes.size() / 2}) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    write_all(folder / "s.png", changed);
    EXPECT_EQ(test::check_by_python(folder.path(), "png"), 1) << at;
  }
  // The picture of one that has another pixel, with all its checksums.
  image.at(85, 55)[1] = static_cast<std::uint8_t>(image.at(85, 55)[1] ^ 1);
  render::write_png(folder / "s.png", image);
  std::string said;
  EXPECT_EQ(test::check_by_python(folder.path(), "png", &said), 1);
  EXPECT_EQ(said, "png: its pixels\n");
}

#else
TEST(GlbByPython, HasEveryFloatColourAndTriangle) { GTEST_SKIP() << "there is no Python here"; }
#endif

}  // namespace
}  // namespace dsc
