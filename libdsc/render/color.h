/// \file
/// Colours: linear light, in which they are mixed; sRGB, in which they are stored; and OKLab, in
/// which equal steps look equal (B. Ottosson 2020, "A perceptual color space for image
/// processing").
#pragma once

#include "libdsc/base/types.h"
#include "libdsc/render/image.h"

namespace dsc::render {

/// Linear red, green and blue with the primaries of sRGB, 0 to 1.
using Rgb = Vec3;
/// Lightness 0 to 1, and two opponent axes, green to red and blue to yellow.
using Lab = Vec3;

/// The other one of the two, of any colour, also of one that no screen shows.
/// @{
Rgb rgb_of(const Lab& lab);
Lab lab_of(const Rgb& rgb);
/// @}
/// Of lightness, chroma and hue (degrees).
Lab lab_of_hue(double lightness, double chroma, double hue);

/// Rounded to bytes; what lies outside 0 to 1 takes the nearer end.
Pixel pixel_of(const Rgb& rgb);
/// The light of a stored colour.
Rgb rgb_of(const Pixel& pixel);

}  // namespace dsc::render
