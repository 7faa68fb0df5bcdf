#include "libdsc/render/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dsc::render {

double round_step(double low, double high, int count) {
  const double width = high - low;
  if (!(width > 0) || !std::isfinite(width) || count < 1) return 0;
  const double least = width / count;
  const double power = std::pow(10., std::floor(std::log10(least)));
  constexpr double kSlack = 1 - 1e-9;  // 0.3 / 3 may be a bit above 0.1
  for (const double factor : {1., 2., 5.}) {
    if (factor * power >= least * kSlack) return factor * power;
  }
  return 10 * power;
}

std::vector<double> multiples(double low, double high, double step) {
  std::vector<double> all;
  if (!(step > 0)) return all;
  const double slack = 1e-9;
  const double first = std::ceil(low / step - slack), last = std::floor(high / step + slack);
  for (double k = first; k <= last; ++k) all.push_back(k * step + 0.);
  return all;
}

std::vector<std::string> tick_texts(const std::vector<double>& values, double step) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  const auto power = [](double x) { return static_cast<int>(std::floor(std::log10(x) + 1e-9)); };
  const int finest = step > 0 ? power(step) : largest > 0 ? power(largest) - 3 : 0;
  const bool powers = largest > 0 && (largest < 1e-3 || largest >= 1e5);
  std::vector<std::string> texts;
  for (const double value : values) {
    if (value == 0) {
      texts.emplace_back("0");
    } else if (!powers) {
      texts.push_back(fmt::format("{:.{}f}", value, std::clamp(-finest, 0, 9)));
    } else {
      const int exponent = power(std::abs(value));
      texts.push_back(fmt::format("{:.{}f}e{}", value / std::pow(10., exponent),
                                  std::clamp(exponent - finest, 0, 6), exponent));
    }
  }
  return texts;
}

}  // namespace dsc::render
