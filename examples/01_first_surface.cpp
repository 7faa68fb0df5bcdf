// The first surface: voxels of the unit sphere, their surface, its normals, and how far every point
// of it is from one of them.
#include "libdsc/algorithms/geodesic.h"
#include "libdsc/normals/integral_invariant.h"
#include "libdsc/normals/radius.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/shapes.h"

#include <iostream>

int main() {
  const double h = 0.05;  // the edge of a voxel
  const dsc::BinaryVolume voxels = dsc::digitize(dsc::Sphere(1.), {h, h, h});
  dsc::DigitalSurface surface = dsc::extract_surface(voxels);

  const dsc::NormalField normals =
      dsc::integral_invariant_normals(voxels, surface.surfels(), {.radius = dsc::shape_radius(h)});
  surface.set_normals(normals.u);

  const dsc::VertexId source = 0;
  const dsc::GeodesicResult result = dsc::geodesic_distance(surface.flat(), {&source, 1});
  std::cout << surface.face_count() << " surfels; the farthest vertex is at "
            << result.distance.maxCoeff() << ", on the sphere at 3.14159\n";
}
