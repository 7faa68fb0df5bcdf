#include "libdsc/render/colormap.h"

#include "libdsc/base/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dsc::render {
namespace {

struct Path {
  const char* name;
  bool diverging;
  Lab (*at)(double t);
};

constexpr double kPi = std::numbers::pi;

// The chromas stay inside sRGB all the way; a test holds them to that.
const Path kPaths[] = {
    {"lagoon", false,
     [](double t) { return lab_of_hue(0.36 + 0.59 * t, 0.088 + 0.052 * t * t, 285 - 180 * t); }},
    {"ember", false,
     [](double t) {
       return lab_of_hue(0.34 + 0.61 * t, 0.092 + 0.05 * std::sin(kPi * t), 285 + 176 * t);
     }},
    {"grey", false, [](double t) { return Lab(0.34 + 0.61 * t, 0., 0.); }},
    {"polar", true,
     [](double t) {
       const double away = std::abs(2 * t - 1);
       return lab_of_hue(0.95 - 0.52 * away, 0.15 * away, t < 0.5 ? 258 : 27);
     }},
};

constexpr int kEntries = 1025;  // odd: one stands at the middle
constexpr int kSteps = 64 * (kEntries - 1);

/// The path at entries that lie the same length of it apart.
std::vector<Rgb> walked(const Path& path) {
  std::vector<double> length(kSteps + 1, 0.);
  Lab last = path.at(0);
  for (int i = 1; i <= kSteps; ++i) {
    const Lab next = path.at(static_cast<double>(i) / kSteps);
    length[static_cast<std::size_t>(i)] =
        length[static_cast<std::size_t>(i - 1)] + (next - last).norm();
    last = next;
  }
  std::vector<Rgb> table;
  for (int k = 0; k < kEntries; ++k) {
    const double wanted = length.back() * k / (kEntries - 1);
    const auto after = std::lower_bound(length.begin(), length.end(), wanted);
    const auto i = static_cast<double>(after - length.begin());
    table.push_back(rgb_of(path.at(std::min(1., i / kSteps))));
  }
  return table;
}

}  // namespace

std::vector<std::string> Colormap::names() {
  std::vector<std::string> all;
  for (const Path& path : kPaths) all.emplace_back(path.name);
  return all;
}

Colormap::Colormap(const std::string& name) : name_(name) {
  for (const Path& path : kPaths) {
    if (name != path.name) continue;
    diverging_ = path.diverging;
    table_ = walked(path);
    return;
  }
  std::string known;
  for (const std::string& other : names()) known += (known.empty() ? "" : ", ") + other;
  throw UsageError("there is no colour map '" + name + "'; there are " + known);
}

Rgb Colormap::operator()(double t) const {
  const double place = std::clamp(t, 0., 1.) * (kEntries - 1);
  const auto i = std::min<std::size_t>(static_cast<std::size_t>(place), kEntries - 2);
  const double part = place - static_cast<double>(i);
  return (1 - part) * table_[i] + part * table_[i + 1];
}

}  // namespace dsc::render
