#include "libdsc/page/palettes.h"

#include "libdsc/render/colormap.h"

#include <cmath>

namespace dsc::detail {
namespace {

constexpr int kEntries = 256;

void append_hex(std::string& out, const render::Rgb& color) {
  constexpr const char* kDigits = "0123456789abcdef";
  for (const std::uint8_t byte : render::pixel_of(color)) {
    out += kDigits[byte >> 4];
    out += kDigits[byte & 15];
  }
}

/// Steps of the golden angle around the circle of hues, so that any few of them in a row lie far
/// apart, on three lightnesses.
Palette labels() {
  Palette palette{"labels", false, {}};
  for (int i = 0; i < kEntries; ++i) {
    const double lightness = 0.72 - 0.09 * (i % 3);
    append_hex(palette.hex,
               render::rgb_of(render::lab_of_hue(lightness, 0.105, 240 + 137.508 * i)));
  }
  return palette;
}

}  // namespace

std::vector<Palette> page_palettes() {
  std::vector<Palette> all;
  for (const std::string& name : render::Colormap::names()) {
    const render::Colormap map(name);
    Palette palette{name, map.diverging(), {}};
    for (int i = 0; i < kEntries; ++i) append_hex(palette.hex, map(i / (kEntries - 1.)));
    all.push_back(std::move(palette));
  }
  all.push_back(labels());
  return all;
}

}  // namespace dsc::detail
