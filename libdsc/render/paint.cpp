#include "libdsc/render/paint.h"

#include "libdsc/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dsc::render {
namespace {

class Plain : public Paint {
 public:
  Coat at(const Hit&, std::span<const VertexId>) const override { return {colour_}; }

 private:
  Rgb colour_ = rgb_of(lab_of_hue(0.87, 0.025, 75));
};

/// A value a vertex or a face, as colour along a map.
class Scalar : public Paint {
 public:
  Scalar(std::string name, FieldOn on, std::vector<double> values, const std::string& map,
         const std::optional<std::array<double, 2>>& range)
      : on_(on), values_(std::move(values)) {
    double least = std::numeric_limits<double>::infinity(), largest = -least;
    for (const double value : values_) {
      if (!std::isfinite(value)) {
        ++missing_;
        continue;
      }
      least = std::min(least, value);
      largest = std::max(largest, value);
    }
    if (least > largest) least = largest = 0;
    key_.title = std::move(name);
    key_.low = range ? (*range)[0] : least;
    key_.high = range ? (*range)[1] : largest;
    key_.below = least < key_.low;
    key_.above = largest > key_.high;
    const bool signed_values = key_.low < 0 && key_.high > 0;
    key_.map.emplace(!map.empty() ? map : signed_values ? "polar" : Colormap::names().front());
    if (missing_ > 0) key_.swatches.push_back({missing_colour(), "infinite"});
  }

  Coat at(const Hit& hit, std::span<const VertexId> corners) const override {
    double value = 0;
    if (on_ == FieldOn::face) {
      value = values_[static_cast<std::size_t>(hit.face)];
    } else {
      for (std::size_t i = 0; i < 4 && hit.slot[i] >= 0; ++i) {
        const VertexId v = corners[static_cast<std::size_t>(hit.slot[i])];
        value += hit.weight[i] * values_[static_cast<std::size_t>(v)];
      }
    }
    if (!std::isfinite(value)) return {missing_colour()};
    Coat coat{key_.colour(value)};
    if (on_ == FieldOn::vertex) coat.value = value;
    return coat;
  }

  Key key() const override { return key_; }
  Index missing() const override { return missing_; }
  bool has_isolines() const override { return on_ == FieldOn::vertex; }

 private:
  Key key_;
  FieldOn on_;
  std::vector<double> values_;
  Index missing_ = 0;
};

/// Lighter upwards, hues around the vertical: the unit sphere as a ball in OKLab.
Rgb colour_of_direction(const Vec3& d) {
  return rgb_of(Lab(0.72 + 0.13 * d[2], 0.105 * d[0], 0.105 * d[1]));
}

class Direction : public Paint {
 public:
  explicit Direction(const Field& field) : field_(field) {}

  Coat at(const Hit& hit, std::span<const VertexId> corners) const override {
    Vec3 sum = Vec3::Zero();
    if (field_.on == FieldOn::face) {
      sum = at(hit.face);
    } else {
      for (std::size_t i = 0; i < 4 && hit.slot[i] >= 0; ++i) {
        sum += hit.weight[i] * at(corners[static_cast<std::size_t>(hit.slot[i])]);
      }
    }
    const double length = sum.norm();
    return {length > 0 ? colour_of_direction(sum / length) : missing_colour()};
  }
  Key key() const override {
    Key key;
    key.title = field_.name;
    for (int i = 0; i < 3; ++i) {
      for (const int sign : {1, -1}) {
        key.swatches.push_back({colour_of_direction(sign * Vec3::Unit(i)),
                                fmt::format("{}{}", sign > 0 ? '+' : '-', "xyz"[i])});
      }
    }
    return key;
  }

 private:
  Vec3 at(Index i) const {
    const double* v = field_.values.data() + 3 * i;
    return {v[0], v[1], v[2]};
  }
  Field field_;
};

/// Colours that differ from each other however many there are: hues by the golden angle.
Rgb colour_of_label(std::size_t rank) {
  const double hue = std::fmod(25 + 137.50776405 * static_cast<double>(rank), 360.);
  return rgb_of(lab_of_hue(rank % 2 == 0 ? 0.74 : 0.66, 0.10, hue));
}

class Labels : public Paint {
 public:
  Labels(std::span<const double> inner, std::span<const double> outer)
      : inner_(inner), outer_(outer) {
    known_.assign(inner.begin(), inner.end());
    known_.insert(known_.end(), outer.begin(), outer.end());
    std::sort(known_.begin(), known_.end());
    known_.erase(std::unique(known_.begin(), known_.end()), known_.end());
    std::erase(known_, 0.);
    for (std::size_t k = 0; k < known_.size(); ++k) colours_.push_back(colour_of_label(k));
  }
  Coat at(const Hit& hit, std::span<const VertexId>) const override {
    const auto f = static_cast<std::size_t>(hit.face);
    const double behind = hit.front ? inner_[f] : outer_[f];
    return {colour_of(behind != 0 ? behind : hit.front ? outer_[f] : inner_[f])};
  }
  Key key() const override {
    constexpr std::size_t kMost = 16;
    Key key;
    key.title = "label";
    for (std::size_t k = 0; k < std::min(kMost, known_.size()); ++k) {
      key.swatches.push_back({colours_[k], fmt::format("{}", known_[k])});
    }
    if (known_.size() > kMost) {
      key.swatches.push_back({Rgb(1, 1, 1), fmt::format("+ {} more", known_.size() - kMost)});
    }
    return key;
  }

 private:
  Rgb colour_of(double label) const {
    const auto place = std::lower_bound(known_.begin(), known_.end(), label);
    return colours_[static_cast<std::size_t>(place - known_.begin())];
  }
  std::span<const double> inner_, outer_;
  std::vector<double> known_;
  std::vector<Rgb> colours_;
};

void check(const FlatMesh& mesh, const Field& field) {
  const Index count = field.on == FieldOn::vertex ? mesh.vertices() : mesh.faces();
  const std::size_t parts = field.parts.size();
  if ((parts != 1 && parts != 3) ||
      field.values.size() != parts * static_cast<std::size_t>(count)) {
    throw UsageError(fmt::format(
        "field {}: {} values of {} parts for {} {}; a picture shows scalars and vectors of 3 parts",
        field.name, field.values.size(), parts, count,
        field.on == FieldOn::vertex ? "vertices" : "faces"));
  }
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    if (std::isnan(field.values[i])) {
      throw InputError(fmt::format("field {} is not a number at {} {}; it is not drawn", field.name,
                                   field.on == FieldOn::vertex ? "vertex" : "face", i / parts));
    }
  }
}

}  // namespace

Rgb Key::colour(double value) const {
  const double v = std::clamp(value, low, high);
  if (map->diverging()) {
    const double most = std::max(std::abs(low), std::abs(high));
    return (*map)(most > 0 ? 0.5 + 0.5 * (v / most) : 0.5);
  }
  return (*map)(high > low ? (v - low) / (high - low) : 0.5);
}

Rgb missing_colour() { return rgb_of(Lab(0.78, 0., 0.)); }

std::unique_ptr<Paint> plain_paint() { return std::make_unique<Plain>(); }

std::unique_ptr<Paint> field_paint(const FlatMesh& mesh, const Field& field, const std::string& map,
                                   const std::optional<std::array<double, 2>>& range) {
  check(mesh, field);
  if (field.parts.size() == 1) {
    return std::make_unique<Scalar>(field.name, field.on,
                                    std::vector<double>(field.values.begin(), field.values.end()),
                                    map, range);
  }
  std::vector<double> lengths(field.values.size() / 3);
  bool unit = true;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    lengths[i] =
        Vec3(field.values[3 * i], field.values[3 * i + 1], field.values[3 * i + 2]).stableNorm();
    unit = unit && (lengths[i] == 0 || std::abs(lengths[i] - 1) < 1e-6);
  }
  if (!unit) {
    return std::make_unique<Scalar>("|" + field.name + "|", field.on, std::move(lengths), map,
                                    range);
  }
  if (!map.empty() || range) {
    throw UsageError("the vectors of " + field.name +
                     " are all unit and shown by their directions, which have no range and no "
                     "colour map; leave both out");
  }
  return std::make_unique<Direction>(field);
}

std::unique_ptr<Paint> label_paint(std::span<const double> inner, std::span<const double> outer) {
  return std::make_unique<Labels>(inner, outer);
}

}  // namespace dsc::render
