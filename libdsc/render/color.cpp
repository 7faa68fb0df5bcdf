#include "libdsc/render/color.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dsc::render {
namespace {

// OKLab is a linear map of the cube roots of the three cone responses. Functions, so that other
// files' constants may be made of them.
const Mat3& cones() {
  static const Mat3 matrix{{0.4122214708, 0.5363325363, 0.0514459929},
                           {0.2119034982, 0.6806995451, 0.1073969566},
                           {0.0883024619, 0.2817188376, 0.6299787005}};
  return matrix;
}
const Mat3& opponents() {
  static const Mat3 matrix{{0.2104542553, 0.7936177850, -0.0040720468},
                           {1.9779984951, -2.4285922050, 0.4505937099},
                           {0.0259040371, 0.7827717662, -0.8086757660}};
  return matrix;
}

double encoded(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double decoded(double stored) {
  return stored <= 0.04045 ? stored / 12.92 : std::pow((stored + 0.055) / 1.055, 2.4);
}

}  // namespace

Rgb rgb_of(const Lab& lab) {
  static const Mat3 to_roots = opponents().inverse(), to_rgb = cones().inverse();
  const Vec3 roots = to_roots * lab;
  return to_rgb * Vec3(roots.array().cube());
}

Lab lab_of(const Rgb& rgb) {
  const Vec3 c = cones() * rgb;
  return opponents() * Vec3(std::cbrt(c[0]), std::cbrt(c[1]), std::cbrt(c[2]));
}

Lab lab_of_hue(double lightness, double chroma, double hue) {
  const double angle = hue * std::numbers::pi / 180;
  return {lightness, chroma * std::cos(angle), chroma * std::sin(angle)};
}

Pixel pixel_of(const Rgb& rgb) {
  Pixel pixel;
  for (int i = 0; i < 3; ++i) {
    const double byte = 255 * encoded(std::clamp(rgb[i], 0., 1.));
    pixel[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::lround(byte));
  }
  return pixel;
}

Rgb rgb_of(const Pixel& pixel) {
  return {decoded(pixel[0] / 255.), decoded(pixel[1] / 255.), decoded(pixel[2] / 255.)};
}

}  // namespace dsc::render
