/// \file
/// Spheres of voxels with their estimated normals.
#pragma once

#include "libdsc/normals/radius.h"
#include "libdsc/normals/surface_normals.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/shapes.h"

namespace dsc::testing {

/// The unit sphere at gridstep h.
inline DigitalSurface sphere(double h, const Vec3& centre = Vec3::Zero()) {
  const BinaryVolume volume = digitize(Sphere(1., centre), Vec3(h, h, h));
  DigitalSurface surface = extract_surface(volume);
  integral_invariant_normals(surface, volume, {.radius = shape_radius(h)});
  return surface;
}

}  // namespace dsc::testing
