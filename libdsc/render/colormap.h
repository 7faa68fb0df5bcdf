/// \file
/// Colour maps, each a path through OKLab that is walked at constant speed, so that equal steps of
/// the value look like equal steps of colour.
///
/// - `lagoon`, for values of one sign: dark violet-blue, teal, green, pale yellow, lighter all the
///   way;
/// - `ember`, likewise: dark violet, crimson, orange, pale yellow;
/// - `grey`, likewise: dark to light;
/// - `polar`, for signed values: blue, near white, red, both arms equally light and strong.
#pragma once

#include "libdsc/render/color.h"

#include <string>
#include <vector>

namespace dsc::render {

/// A map, made by its name. Copies are cheap enough for a picture, not for a pixel.
class Colormap {
 public:
  /// \throws UsageError for a name that is not one of these, naming those that are.
  explicit Colormap(const std::string& name);

  /// The colour at t in [0, 1]; beyond, that of the nearer end.
  Rgb operator()(double t) const;

  /// The name that it was made by.
  const std::string& name() const { return name_; }
  /// Whether the middle stands for 0.
  bool diverging() const { return diverging_; }

  /// The names, the first being the default for values of one sign.
  static std::vector<std::string> names();

 private:
  std::string name_;
  bool diverging_ = false;
  std::vector<Rgb> table_;
};

}  // namespace dsc::render
