/// \file
/// \internal
/// What a surface is coloured by: a scalar, a direction, its labels, or nothing.
#pragma once

#include "libdsc/io/results.h"
#include "libdsc/render/colormap.h"
#include "libdsc/render/tracer.h"

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dsc::render {

/// Of a point of the surface, before it is lit.
struct Coat {
  Rgb colour{0, 0, 0};
  double value = std::numeric_limits<double>::quiet_NaN();  ///< for isolines; NaN: none here
};

/// A colour and what it stands for.
struct Swatch {
  Rgb colour;
  std::string text;
};

/// What the picture says of its colours.
struct Key {
  std::string title;
  std::optional<Colormap> map;  ///< then there is a bar from low to high
  double low = 0, high = 0;
  bool below = false, above = false;  ///< whether values lie beyond the ends
  std::vector<Swatch> swatches;

  /// The colour of a value; beyond the ends, that of the nearer end. A diverging map has 0 in its
  /// middle and as many steps a unit to both sides, so that the bar may show but a part of it.
  Rgb colour(double value) const;
};

class Paint {
 public:
  Paint() = default;
  Paint(const Paint&) = delete;
  Paint& operator=(const Paint&) = delete;
  virtual ~Paint() = default;

  /// `corners` are those of the face that was hit.
  virtual Coat at(const Hit& hit, std::span<const VertexId> corners) const = 0;
  virtual Key key() const { return {}; }
  /// How many values the field lacks: infinite ones, drawn grey.
  virtual Index missing() const { return 0; }
  /// Whether isolines can be drawn: between vertices values change smoothly.
  virtual bool has_isolines() const { return false; }
};

/// One colour everywhere.
std::unique_ptr<Paint> plain_paint();

/// A scalar by its colour; a field of vectors by their lengths, or, where all are unit or 0, by
/// their directions. `map` empty: lagoon, or polar where values have both signs. `range` not given:
/// from the least to the largest finite value.
/// \throws UsageError where a map or a range is asked for and directions are shown, and where a
/// field's size is not that of the mesh; InputError where it is NaN somewhere.
std::unique_ptr<Paint> field_paint(const FlatMesh& mesh, const Field& field, const std::string& map,
                                   const std::optional<std::array<double, 2>>& range);

/// Interfaces between labels: each face by the label behind it, as seen, 0 being the outside that
/// nobody looks at.
std::unique_ptr<Paint> label_paint(std::span<const double> inner, std::span<const double> outer);

/// What missing values are drawn in.
Rgb missing_colour();

}  // namespace dsc::render
