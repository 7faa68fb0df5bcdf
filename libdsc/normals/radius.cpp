#include "libdsc/normals/radius.h"

#include "libdsc/base/error.h"

#include <cmath>
#include <string>

namespace dsc {

double shape_radius(double h) {
  if (!(h > 0) || !std::isfinite(h)) {
    throw UsageError("radius: the gridstep must be positive and finite, not " + std::to_string(h));
  }
  return 3. * std::sqrt(h);
}

double data_radius(const Vec3& spacing, double voxels) {
  const double radius = voxels * spacing.maxCoeff();
  if (!(radius > 0) || !std::isfinite(radius)) {
    throw UsageError("radius: " + std::to_string(voxels) + " voxels of edge " +
                     std::to_string(spacing.maxCoeff()) + " is no ball; give a positive number");
  }
  return radius;
}

}  // namespace dsc
