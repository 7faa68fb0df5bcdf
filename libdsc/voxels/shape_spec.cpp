#include "libdsc/voxels/shape_spec.h"

#include "libdsc/base/error.h"
#include "libdsc/voxels/expression_shape.h"
#include "libdsc/voxels/shape_rows.h"
#include "libdsc/voxels/shapes.h"

#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <string_view>

namespace dsc {
namespace {

using Values = std::map<std::string, double, std::less<>>;

struct Entry {
  const char* name;
  std::vector<std::pair<const char*, double>> keys;  ///< with their defaults
  std::function<std::unique_ptr<ImplicitShape>(const Values&)> make;
};

const std::vector<Entry>& entries() {
  static const std::vector<Entry> table = {
      {"sphere",
       {{"r", 1.}, {"cx", 0.}, {"cy", 0.}, {"cz", 0.}},
       [](const Values& v) {
         return std::make_unique<Sphere>(v.at("r"), Vec3(v.at("cx"), v.at("cy"), v.at("cz")));
       }},
      {"ellipsoid",
       {{"a", 1.}, {"b", 0.8}, {"c", 0.6}},
       [](const Values& v) {
         return std::make_unique<Ellipsoid>(Vec3(v.at("a"), v.at("b"), v.at("c")));
       }},
      {"torus",
       {{"R", 1.}, {"r", 0.4}},
       [](const Values& v) { return std::make_unique<Torus>(v.at("R"), v.at("r")); }},
      {"rounded-cube",
       {{"r", 1.}},
       [](const Values& v) { return std::make_unique<RoundedCube>(v.at("r")); }},
      {"goursat", {}, [](const Values&) { return std::make_unique<Goursat>(); }},
      {"leopold", {}, [](const Values&) { return std::make_unique<Leopold>(); }},
      {"heart", {}, [](const Values&) { return std::make_unique<Heart>(); }},
      {"plane",
       {{"nx", 1.}, {"ny", 1.}, {"nz", 1.}, {"d", 0.}, {"size", 10.}},
       [](const Values& v) {
         return std::make_unique<Plane>(Vec3(v.at("nx"), v.at("ny"), v.at("nz")), v.at("d"),
                                        v.at("size"));
       }},
  };
  return table;
}

constexpr const char* kExpressionForm = "expr:EXPR;box=LO,HI  or  ;box=X0,Y0,Z0,X1,Y1,Z1  [;open]";

double strict_number(std::string_view text, const std::string& what) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
    throw UsageError(what + ": '" + std::string(text) + "' is not a finite number");
  }
  return value;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t at = text.find(separator);
    parts.push_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

std::unique_ptr<ImplicitShape> make_expression(const std::string& spec) {
  const std::vector<std::string_view> parts = split(std::string_view(spec).substr(5), ';');
  std::vector<double> box;
  bool open = false;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (parts[i] == "open") {
      open = true;
    } else if (parts[i].substr(0, 4) == "box=" && box.empty()) {
      for (const std::string_view number : split(parts[i].substr(4), ',')) {
        box.push_back(strict_number(number, "shape '" + spec + "', box"));
      }
    } else {
      throw UsageError("shape '" + spec + "': '" + std::string(parts[i]) +
                       "' is not understood; the form is " + kExpressionForm);
    }
  }
  Eigen::AlignedBox3d bounds;
  if (box.size() == 2) {
    bounds = {Vec3::Constant(box[0]), Vec3::Constant(box[1])};
  } else if (box.size() == 6) {
    bounds = {Vec3(box[0], box[1], box[2]), Vec3(box[3], box[4], box[5])};
  } else {
    throw UsageError("shape '" + spec +
                     "': an expression needs a box of 2 or 6 numbers; the form is " +
                     kExpressionForm);
  }
  return std::make_unique<ExpressionShape>(std::string(parts[0]), bounds, open);
}

std::string describe(const Entry& entry) {
  std::string line = entry.name;
  for (const auto& [key, value] : entry.keys) line += "," + std::string(key) + "=" + text_of(value);
  return line;
}

std::string known_names() {
  std::string names;
  for (const std::string& line : known_shapes()) names += "\n  " + line;
  return names;
}

}  // namespace

std::vector<std::string> known_shapes() {
  std::vector<std::string> lines;
  for (const Entry& entry : entries()) lines.push_back(describe(entry));
  lines.emplace_back(kExpressionForm);
  return lines;
}

std::unique_ptr<ImplicitShape> make_shape(const std::string& spec) {
  if (spec.rfind("expr:", 0) == 0) return make_expression(spec);
  const std::vector<std::string_view> parts = split(spec, ',');
  const Entry* entry = nullptr;
  for (const Entry& candidate : entries()) {
    if (parts[0] == candidate.name) entry = &candidate;
  }
  if (entry == nullptr) {
    throw UsageError("shape '" + std::string(parts[0]) +
                     "' is unknown; the shapes and their keys:" + known_names());
  }
  Values values;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const std::size_t at = parts[i].find('=');
    const std::string key(parts[i].substr(0, at));
    bool known = false;
    for (const auto& [name, value] : entry->keys) known = known || key == name;
    if (!known || at == std::string_view::npos) {
      throw UsageError("shape '" + spec + "': '" + std::string(parts[i]) +
                       "' is not one of its key=value pairs: " + describe(*entry));
    }
    const double value = strict_number(parts[i].substr(at + 1), "shape '" + spec + "', " + key);
    if (!values.emplace(key, value).second) {
      throw UsageError("shape '" + spec + "': " + key + " is given twice");
    }
  }
  for (const auto& [key, value] : entry->keys) values.emplace(key, value);
  return entry->make(values);
}

}  // namespace dsc
