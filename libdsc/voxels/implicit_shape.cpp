#include "libdsc/voxels/implicit_shape.h"

namespace dsc {

void ImplicitShape::values_along_x(double step, Index first, int count, double y, double z,
                                   double* out) const {
  for (int k = 0; k < count; ++k) {
    out[k] = value(Vec3(step * static_cast<double>(first + k), y, z));
  }
}

}  // namespace dsc
