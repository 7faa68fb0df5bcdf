/// \file
/// \internal
/// How much light comes back from a point of a surface.
#pragma once

#include "libdsc/base/types.h"

namespace dsc::render {

/// One light from above the viewer's left shoulder, and light from everywhere.
struct Lighting {
  double ambient = 0.45;  ///< the part from everywhere, 0 to 1; 1: colours as in the colour bar

  /// 1 where a unit normal points at the light, `ambient` where it points away. The normal is in
  /// the axes of the picture: to the right, up, towards the viewer.
  double operator()(const Vec3& normal) const;
};

}  // namespace dsc::render
