#include "libdsc/voxels/grid.h"

#include "libdsc/base/error.h"

#include <cmath>

namespace dsc {
namespace {

/// Keeps sizes with their margins, in doubled coordinates too, far from overflow.
constexpr Index kLongestAxis = Index{1} << 40;

}  // namespace

void Grid::check() const {
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    if (size[a] < 0) {
      throw InputError("volume: negative size " + std::to_string(size[a]) + " along axis " +
                       std::to_string(axis));
    }
    if (size[a] > kLongestAxis) {
      throw LimitError("volume: " + std::to_string(size[a]) + " voxels along axis " +
                       std::to_string(axis) + " are more than 2^40");
    }
    if (!(spacing[axis] > 0) || !std::isfinite(spacing[axis]) || !std::isfinite(origin[axis])) {
      throw InputError("volume: the spacing must be positive and finite, the origin finite; axis " +
                       std::to_string(axis) + " has spacing " + std::to_string(spacing[axis]));
    }
  }
  (void)voxels();
}

std::string Grid::text() const {
  return std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " +
         std::to_string(size[2]) + " voxels";
}

}  // namespace dsc
