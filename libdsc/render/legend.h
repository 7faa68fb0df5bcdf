/// \file
/// \internal
/// What a picture says of its colours: a bar with numbers, or a list of swatches.
#pragma once

#include "libdsc/render/canvas.h"
#include "libdsc/render/paint.h"

namespace dsc::render {

/// Pixels that the key takes at the right side of a picture; 0 where it says nothing.
double key_width(const Key& key, const Canvas& canvas, double height);

/// Draws it into `area`. Isolines cross the bar at the multiples of `isoline_step`, where that is
/// not 0. An end of the bar beyond which there are values is pointed.
void draw_key(const Key& key, double isoline_step, const Rgb& line_colour, Canvas& canvas,
              const Rectangle& area);

}  // namespace dsc::render
