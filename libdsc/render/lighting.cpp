#include "libdsc/render/lighting.h"

#include <algorithm>

namespace dsc::render {

double Lighting::operator()(const Vec3& normal) const {
  static const Vec3 light = Vec3(-0.45, 0.6, 1.).normalized();
  return ambient + (1 - ambient) * std::clamp(normal.dot(light), 0., 1.);
}

}  // namespace dsc::render
