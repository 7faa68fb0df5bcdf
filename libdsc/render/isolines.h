/// \file
/// \internal
/// Lines of constant value, of constant width in the picture: how far a point lies from the nearest
/// line is what is missing to its value, over how fast values go there in the picture.
#pragma once

namespace dsc::render {

/// How fast values go from here towards `level` within a pixel to either side, whichever side is
/// faster; 0 where both go away from it. NaN before or after: nothing is there, or what does not
/// belong to this part of the surface. On a staircase the values on both sides of a step bridge it,
/// so that lines do not break there.
double approach(double before, double here, double after, double level);

/// The values at a point and a pixel to its left, right, above and below.
struct Neighbourhood {
  double here, left, right, above, below;
};

/// How much of the point, 0 to 1, a line `width` pixels wide covers that runs where the value is a
/// multiple of `step`; edges fade over `soft` pixels.
double line_coverage(const Neighbourhood& values, double step, double width, double soft);

}  // namespace dsc::render
