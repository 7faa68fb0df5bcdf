/// \file
/// \internal
/// Letters, digits and signs as strokes: text without a font file.
#pragma once

#include "libdsc/base/types.h"

#include <string>
#include <utility>
#include <vector>

namespace dsc::render {

/// A straight piece of a stroke, in units of a seventh of the height of a capital: x from the left,
/// y up from the base line.
using Segment = std::pair<Eigen::Vector2d, Eigen::Vector2d>;

struct StrokedText {
  std::vector<Segment> segments;
  double width = 0;  ///< to the right end of the last character
};

/// A line of text. A character that the font lacks, and each byte beyond ASCII, is a box.
StrokedText stroked(const std::string& text);

}  // namespace dsc::render
