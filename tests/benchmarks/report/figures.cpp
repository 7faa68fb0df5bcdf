#include "tests/benchmarks/report/figures.h"

#include "tests/benchmarks/report/process.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace report {
namespace {

using Json = nlohmann::json;

constexpr double kFitFrom = 9e4;  // faces: below, fixed costs hide the growth

/// n in `…/n:73/…`; 0 for spot, -1 where there is none.
int size_of(const std::string& name) {
  const std::size_t at = name.find("/n:");
  return at == std::string::npos ? -1 : std::stoi(name.substr(at + 3));
}

bool taken(const std::string& name, Extent extent) {
  const int n = size_of(name);
  switch (extent) {
    case Extent::full:
      return true;
    case Extent::quick:
      return n < 0 || n == 23 || n == 73;
    case Extent::smoke:
      return n == 23 || name == "scan";
  }
  return false;
}

/// Without Google Benchmark's own additions.
std::string stripped(std::string name) {
  for (const char* added : {"/iterations:1", "/manual_time"}) {
    const std::size_t at = name.find(added);
    if (at != std::string::npos) name.erase(at, std::string(added).size());
  }
  return name;
}

std::string without_size(std::string name) {
  const std::size_t at = name.find("/n:");
  if (at != std::string::npos) name.erase(at, name.find('/', at + 1) - at);
  return name;
}

/// Metacharacters of extended regular expressions do not occur in names.
Figure measure(const std::string& benchmarks, const std::string& full_name) {
  const std::string text =
      output_of({benchmarks, "--benchmark_filter=^" + full_name + "$", "--benchmark_format=json"});
  const Json result = Json::parse(text).at("benchmarks").at(0);
  Figure figure;
  figure.name = stripped(full_name);
  figure.family = without_size(figure.name);
  if (result.contains("error_message")) {
    fmt::print(stderr, "{}: {}\n", figure.name, result["error_message"].get<std::string>());
    return figure;
  }
  figure.seconds = 1e-3 * result.at("real_time").get<double>();  // ms, as all are registered
  figure.ceiling = result.value("label", "");
  for (const auto& [key, value] : result.items()) {
    if (value.is_number()) figure.counters[key] = value.get<double>();
  }
  return figure;
}

}  // namespace

double Figure::counter(const std::string& key) const {
  const auto found = counters.find(key);
  if (found == counters.end()) throw std::out_of_range(name + " has no counter " + key);
  return found->second;
}

std::optional<double> Figure::maybe(const std::string& key) const {
  const auto found = counters.find(key);
  if (found == counters.end()) return {};
  return found->second;
}

Figures::Figures(const std::string& benchmarks, Extent extent) {
  std::istringstream names(output_of({benchmarks, "--benchmark_list_tests"}));
  std::string name;
  while (std::getline(names, name)) {
    if (!taken(stripped(name), extent)) continue;
    fmt::print("{:<40}", stripped(name));
    std::fflush(stdout);
    figures_.push_back(measure(benchmarks, name));
    fmt::print(" {:.4g} s\n", figures_.back().seconds);
  }
  if (figures_.empty()) throw std::runtime_error(benchmarks + " has no benchmark");
}

const Figure* Figures::find(const std::string& name) const {
  for (const Figure& figure : figures_) {
    if (figure.name == name) return &figure;
  }
  return nullptr;
}

std::vector<const Figure*> Figures::family(const std::string& name) const {
  std::vector<const Figure*> members;
  for (const Figure& figure : figures_) {
    if (figure.family == name && figure.maybe("faces")) members.push_back(&figure);
  }
  std::sort(members.begin(), members.end(),
            [](const Figure* a, const Figure* b) { return a->faces() < b->faces(); });
  return members;
}

std::vector<std::string> Figures::families() const {
  std::vector<std::string> names;
  for (const Figure& figure : figures_) {
    if (figure.maybe("faces") &&
        std::find(names.begin(), names.end(), figure.family) == names.end()) {
      names.push_back(figure.family);
    }
  }
  return names;
}

double Figures::rate(const std::string& ceiling) const {
  const Figure* figure = find("ceiling/" + ceiling);
  return figure == nullptr ? 0. : figure->maybe("rate").value_or(0.);
}

std::optional<double> Figures::share(const Figure& figure) const {
  const std::optional<double> floor = figure.maybe("floor");
  const std::string name = figure.ceiling == "memory" ? "triad/threads:2" : figure.ceiling;
  const double per_second = rate(name);
  if (!floor || !(per_second > 0) || !(figure.seconds > 0)) return {};
  return *floor / per_second / figure.seconds;
}

std::optional<double> Figures::exponent(const std::string& name) const {
  std::vector<std::pair<double, double>> points;
  for (const Figure* figure : family(name)) {
    if (size_of(figure->name) > 0 && figure->faces() > kFitFrom) {
      points.emplace_back(std::log(figure->faces()), std::log(figure->seconds));
    }
  }
  if (points.size() < 2) return {};
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& [a, b] : points) {
    x += a;
    y += b;
    xx += a * a;
    xy += a * b;
  }
  const auto n = static_cast<double>(points.size());
  return (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace report
