#include "libdsc/cli/numbers.h"

#include "libdsc/base/error.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace dsc::cli {

std::vector<double> parse_numbers(std::string_view text, const std::string& option) {
  std::vector<double> numbers;
  const std::string all(text);
  while (true) {
    const std::size_t comma = text.find(',');
    std::string_view word = text.substr(0, comma);
    if (!word.empty() && word.front() == '+') word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
      throw UsageError(option + " " + all + ": '" + std::string(word) + "' is not a number");
    }
    numbers.push_back(value);
    if (comma == std::string_view::npos) return numbers;
    text.remove_prefix(comma + 1);
  }
}

Vec3 parse_point(std::string_view text, const std::string& option) {
  const std::vector<double> numbers = parse_numbers(text, option);
  if (numbers.size() != 3) {
    throw UsageError(option + " " + std::string(text) + ": expected x,y,z");
  }
  return {numbers[0], numbers[1], numbers[2]};
}

Vec3 parse_spacing(std::string_view text, const std::string& option) {
  const std::vector<double> numbers = parse_numbers(text, option);
  if (numbers.size() != 1 && numbers.size() != 3) {
    throw UsageError(option + " " + std::string(text) + ": expected one number or hx,hy,hz");
  }
  const Vec3 spacing =
      numbers.size() == 1 ? Vec3::Constant(numbers[0]) : Vec3(numbers[0], numbers[1], numbers[2]);
  if (!(spacing.array() > 0).all()) {
    throw UsageError(option + " " + std::string(text) + ": must be positive");
  }
  return spacing;
}

Index3 parse_size(std::string_view text, const std::string& option) {
  const std::vector<double> n = parse_numbers(text, option);
  const bool whole = std::all_of(
      n.begin(), n.end(), [](double v) { return v >= 1 && v <= 0x1p40 && v == std::floor(v); });
  if (n.size() != 3 || !whole) {
    throw UsageError(option + " " + std::string(text) + ": expected X,Y,Z, whole and positive");
  }
  return {static_cast<Index>(n[0]), static_cast<Index>(n[1]), static_cast<Index>(n[2])};
}

Index parse_bytes(std::string_view text, const std::string& option) {
  constexpr std::string_view kUnits = "KMG";
  std::string_view digits = text;
  double unit = 1;
  const std::size_t which = text.empty() ? std::string_view::npos : kUnits.find(text.back());
  if (which != std::string_view::npos) {
    unit = std::ldexp(1., 10 * (static_cast<int>(which) + 1));
    digits.remove_suffix(1);
  }
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const double bytes = value * unit;
  if (error != std::errc() || end != digits.data() + digits.size() ||
      !(bytes >= 1 && bytes < 0x1p62)) {
    throw UsageError(option + " " + std::string(text) +
                     ": expected a positive size in bytes, such as 500M or 2G");
  }
  return static_cast<Index>(bytes);
}

LabelPair parse_labels(std::string_view text, const std::string& option) {
  const auto is_label = [](double n) {
    return n >= 0 && n <= std::numeric_limits<Label>::max() && n == std::floor(n);
  };
  const std::vector<double> n = parse_numbers(text, option);
  if (n.size() != 2 || !is_label(n[0]) || !is_label(n[1]) || n[0] == n[1]) {
    throw UsageError(option + " " + std::string(text) +
                     ": expected A,B, two different labels from 0 to 4294967295");
  }
  return {static_cast<Label>(n[0]), static_cast<Label>(n[1])};
}

}  // namespace dsc::cli
