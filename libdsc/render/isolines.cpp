#include "libdsc/render/isolines.h"

#include <algorithm>
#include <cmath>

namespace dsc::render {

double approach(double before, double here, double after, double level) {
  const double sense = level < here ? -1 : 1;
  double fastest = 0;
  for (const double other : {before, after}) {
    if (!std::isnan(other)) fastest = std::max(fastest, sense * (other - here));
  }
  return fastest;
}

double line_coverage(const Neighbourhood& v, double step, double width, double soft) {
  const double level = step * std::round(v.here / step);
  const double steepness = std::hypot(approach(v.left, v.here, v.right, level),
                                      approach(v.above, v.here, v.below, level));
  if (!(steepness > 0)) return 0;
  const double distance = std::abs(v.here - level) / steepness;
  return std::clamp((width / 2 - distance) / soft + 0.5, 0., 1.);
}

}  // namespace dsc::render
