// What is drawn flat, and how it is stored: text, bars, ticks, PNG.
#include "libdsc/base/error.h"
#include "libdsc/render/canvas.h"
#include "libdsc/render/png_file.h"
#include "libdsc/render/stroke_font.h"
#include "libdsc/render/ticks.h"
#include "tests/io/temporary_folder.h"

#include <gtest/gtest.h>

#include <png.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>

namespace dsc::render {
namespace {

/// By libpng, from the bytes of a file.
Image read_png(const std::string& bytes) {
  png_image control{};
  control.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&control, bytes.data(), bytes.size()), 0);
  control.format = PNG_FORMAT_RGB;
  Image image(static_cast<int>(control.width), static_cast<int>(control.height));
  EXPECT_NE(png_image_finish_read(&control, nullptr, image.pixels.data(), 0, nullptr), 0);
  return image;
}

Image noise(int width, int height) {
  Image image(width, height);
  std::mt19937 random(5);
  for (Pixel& pixel : image.pixels) {
    for (std::uint8_t& byte : pixel) byte = static_cast<std::uint8_t>(random());
  }
  return image;
}

TEST(Png, ReadBackIsTheSameBitByBit) {
  for (const auto& [width, height] : {std::pair{1, 1}, {37, 11}, {256, 100}}) {
    const Image image = noise(width, height);
    EXPECT_EQ(read_png(png_bytes(image)), image);
  }
}

TEST(Png, TheFileIsWrittenWholeOrNotAtAll) {
  const TemporaryFolder folder;
  const std::string path = folder / "picture.png";
  write_png(path, noise(20, 10));
  EXPECT_EQ(read_png(read_all(path)), noise(20, 10));
  EXPECT_THROW(write_png(folder / "missing/picture.png", noise(2, 2)), OutputError);
}

TEST(Ticks, StepsAreRoundAndAsManyAsAskedFor) {
  for (const double scale : {1e-9, 0.37, 1., 41., 6e11}) {
    for (int count = 1; count < 40; ++count) {
      const double step = round_step(-0.2 * scale, scale, count);
      EXPECT_LE(1.2 * scale / step, count * (1 + 1e-6));
      EXPECT_GT(1.2 * scale / step, count / 2.5 - 1e-6);  // the next smaller would be too many
      const double mantissa = step / std::pow(10., std::floor(std::log10(step) + 1e-9));
      EXPECT_TRUE(std::abs(mantissa - 1) < 1e-6 || std::abs(mantissa - 2) < 1e-6 ||
                  std::abs(mantissa - 5) < 1e-6)
          << mantissa;
    }
  }
  EXPECT_EQ(round_step(0, 0.3, 3), 0.1);
  EXPECT_EQ(round_step(2, 2, 5), 0);
  EXPECT_EQ(round_step(0, 1, 0), 0);
}

TEST(Ticks, MultiplesIncludeTheEnds) {
  EXPECT_EQ(multiples(0, 1, 0.25), (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
  EXPECT_EQ(multiples(-0.9, 1.1, 0.5), (std::vector<double>{-0.5, 0, 0.5, 1}));
  EXPECT_EQ(multiples(0, 0.3, 0.1).size(), 4U);
  EXPECT_TRUE(multiples(0, 1, 0).empty());
}

TEST(Ticks, TextsReadBackToTheNumbers) {
  for (const double step : {1e-8, 2e-4, 0.05, 0.5, 1., 20., 5e7}) {
    const std::vector<double> values = multiples(-3.3 * step, 7.2 * step, step);
    const std::vector<std::string> texts = tick_texts(values, step);
    ASSERT_EQ(texts.size(), values.size());
    for (std::size_t i = 0; i < texts.size(); ++i) {
      EXPECT_NEAR(std::stod(texts[i]), values[i], 1e-6 * step) << texts[i];
      EXPECT_LE(texts[i].size(), 8U) << texts[i];
    }
    EXPECT_EQ(std::set<std::string>(texts.begin(), texts.end()).size(), texts.size());
  }
  EXPECT_EQ(tick_texts({0.25, 0.5}, 0.05), (std::vector<std::string>{"0.25", "0.50"}));
}

TEST(StrokeFont, EveryCharacterOfNamesAndNumbersHasItsOwnStrokes) {
  const std::string known =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_|.,:-+=/()";
  const auto shape = [](char sign) {
    std::vector<double> numbers;
    for (const auto& [a, b] : stroked(std::string(1, sign)).segments) {
      numbers.insert(numbers.end(), {a[0], a[1], b[0], b[1]});
    }
    return numbers;
  };
  std::set<std::vector<double>> shapes = {shape('~')};  // the box of an unknown one
  for (const char sign : known) EXPECT_TRUE(shapes.insert(shape(sign)).second) << sign;
  EXPECT_EQ(shape('~'), shape('#'));
  EXPECT_TRUE(stroked(" ").segments.empty());
  EXPECT_EQ(stroked("").width, 0);
  for (const char sign : known) {  // none reaches out of its line, or to the left
    for (const auto& [a, b] : stroked(std::string(1, sign)).segments) {
      for (const auto& p : {a, b}) {
        EXPECT_GE(p[0], -0.01) << sign;
        EXPECT_GE(p[1], -2.1) << sign;
        EXPECT_LE(p[1], 7.7) << sign;
      }
    }
  }
}

TEST(Canvas, AreasAreCoveredAsMuchAsTheyAre) {
  const auto ink = [](const Image& image) {
    double sum = 0;
    for (const Pixel& pixel : image.pixels) sum += 1 - rgb_of(pixel)[0];
    return sum;
  };
  Image image(60, 40);
  Canvas(image, 2).fill({10.25, 5.5, 20.5, 7.25}, Rgb(0, 0, 0));
  EXPECT_NEAR(ink(image), 20.5 * 7.25, 0.3);
  EXPECT_EQ(image.at(20, 9), (Pixel{0, 0, 0}));
  EXPECT_EQ(image.at(9, 9), (Pixel{255, 255, 255}));
  image = Image(60, 40);
  Canvas(image, 2).triangle({{{5, 5}, {45, 5}, {5, 35}}}, Rgb(0, 0, 0));
  EXPECT_NEAR(ink(image), 0.5 * 40 * 30, 6);
  image = Image(60, 40);
  const Segment line{{10, 10}, {40, 30}};
  Canvas(image, 2).stroke({&line, 1}, 3, Rgb(0, 0, 0));
  EXPECT_NEAR(ink(image), 3 * std::hypot(30, 20) + std::numbers::pi * 1.5 * 1.5, 4);
  image = Image(60, 40);
  Canvas(image, 2).text(-20, 20, "beyond all edges 0123456789", Rgb(0, 0, 0));  // only clipped
  EXPECT_GT(ink(image), 50);
}

}  // namespace
}  // namespace dsc::render
