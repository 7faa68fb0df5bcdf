#include "libdsc/render/legend.h"

#include "libdsc/render/stroke_font.h"
#include "libdsc/render/ticks.h"

#include <algorithm>
#include <cmath>

namespace dsc::render {
namespace {

// In units of the text, of which a capital has 7.
constexpr double kBarWidth = 9, kGap = 3, kLine = 14, kSwatch = 8;
const Rgb kInk(0.02, 0.02, 0.025);

struct Ticks {
  std::vector<double> values;
  std::vector<std::string> texts;
};

/// A round number every five lines of text, and no fewer than two in all.
Ticks ticks_of(const Key& key, double bar_height, double unit) {
  const int most = std::clamp(static_cast<int>(bar_height / (3 * kLine * unit)), 2, 10);
  const double step = round_step(key.low, key.high, most);
  Ticks ticks;
  ticks.values = multiples(key.low, key.high, step);
  if (ticks.values.size() < 2) ticks.values = {key.low, key.high};
  if (!(key.high > key.low)) ticks.values = {key.low};
  ticks.texts = tick_texts(ticks.values, step);
  return ticks;
}

double bar_height_of(const Key& key, double height, double unit) {
  const double rest = kLine * unit * static_cast<double>(key.swatches.size() + 2);
  return std::max(4 * unit, std::min(0.6 * height, height - rest));
}

std::size_t visible_swatches(const Key& key, double height, double unit) {
  const double room = key.map ? height : height - kLine * unit;
  return std::min(key.swatches.size(),
                  static_cast<std::size_t>(std::max(0., room / (kLine * unit))));
}

void draw_bar(const Key& key, const Rectangle& bar, double isoline_step, const Rgb& line_colour,
              Canvas& canvas) {
  const double unit = canvas.unit(), bottom = bar.top + bar.height;
  const auto place = [&](double value) {
    const double width = key.high - key.low;
    return bottom - bar.height * (width > 0 ? (value - key.low) / width : 0.5);
  };
  const int rows = std::max(1, static_cast<int>(std::lround(bar.height)));
  for (int i = 0; i < rows; ++i) {
    const double value = key.high - (key.high - key.low) * (i + 0.5) / rows;
    canvas.fill({bar.left, std::round(bar.top) + i, bar.width, 1}, key.colour(value));
  }
  const double tip = 0.8 * bar.width, right = bar.left + bar.width,
               middle = bar.left + bar.width / 2;
  const double top = std::round(bar.top), end = top + rows;
  if (key.above) {
    canvas.triangle({{{bar.left, top}, {right, top}, {middle, top - tip}}}, key.colour(key.high));
  }
  if (key.below) {
    canvas.triangle({{{bar.left, end}, {right, end}, {middle, end + tip}}}, key.colour(key.low));
  }
  for (const double value : multiples(key.low, key.high, isoline_step)) {
    const Segment line{{bar.left, place(value)}, {right, place(value)}};
    canvas.stroke({&line, 1}, std::max(1., 0.45 * unit), line_colour);
  }
  const Ticks ticks = ticks_of(key, bar.height, unit);
  for (std::size_t i = 0; i < ticks.values.size(); ++i) {
    const double y = place(ticks.values[i]);
    const Segment mark{{right + 0.8 * unit, y}, {right + 2.4 * unit, y}};
    canvas.stroke({&mark, 1}, std::max(1., 0.6 * unit), kInk);
    canvas.text(right + 4.4 * unit, y + 3.5 * unit, ticks.texts[i], kInk);
  }
}

}  // namespace

double key_width(const Key& key, const Canvas& canvas, double height) {
  const double unit = canvas.unit();
  double width = key.title.empty() ? 0 : canvas.text_width(key.title);
  if (key.map) {
    for (const std::string& text : ticks_of(key, bar_height_of(key, height, unit), unit).texts) {
      width = std::max(width, (kBarWidth + 4.4) * unit + canvas.text_width(text));
    }
  }
  for (const Swatch& swatch : key.swatches) {
    width = std::max(width, (kSwatch + kGap) * unit + canvas.text_width(swatch.text));
  }
  return width;
}

void draw_key(const Key& key, double isoline_step, const Rgb& line_colour, Canvas& canvas,
              const Rectangle& area) {
  const double unit = canvas.unit();
  const double bar_height = key.map ? bar_height_of(key, area.height, unit) : 0;
  const std::size_t swatches = visible_swatches(key, area.height - bar_height, unit);
  const double tips = kBarWidth * unit * ((key.above ? 0.8 : 0) + (key.below ? 0.8 : 0));
  const double title = key.title.empty() ? 0 : (7 + 7) * unit;
  const double all = title + bar_height + tips + kLine * unit * static_cast<double>(swatches);
  double y = area.top + std::max(0., (area.height - all) / 2);
  if (title > 0) canvas.text(area.left, y + 7 * unit, key.title, kInk);
  y += title;
  if (key.map) {
    if (key.above) y += 0.8 * kBarWidth * unit;
    const Rectangle bar{std::round(area.left), y, std::round(kBarWidth * unit), bar_height};
    draw_bar(key, bar, isoline_step, line_colour, canvas);
    y += bar_height + (key.below ? 0.8 * kBarWidth * unit : 0) + (swatches > 0 ? 9 * unit : 0);
  }
  for (std::size_t i = 0; i < swatches; ++i, y += kLine * unit) {
    canvas.fill({area.left, y, kSwatch * unit, kSwatch * unit}, key.swatches[i].colour);
    canvas.text(area.left + (kSwatch + kGap) * unit, y + 7.5 * unit, key.swatches[i].text, kInk);
  }
}

}  // namespace dsc::render
