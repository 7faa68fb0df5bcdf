#include "libdsc/page/arrays.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace dsc::detail {
namespace {

std::int32_t bits_of(double value) {
  return std::bit_cast<std::int32_t>(static_cast<float>(value));
}

/// The integers of positions on the lattice through the first of them, if all are on it.
bool find_lattice(Vec3View positions, PagePositions& to) {
  constexpr double kTolerance = 1e-9;    // of a step
  constexpr double kFarthest = 1 << 22;  // steps, within which a double can tell 1e-9 of one
  double extent = 0;
  for (Index v = 0; v < positions.size; ++v) {
    const Vec3 place = (positions[v] - to.origin).cwiseQuotient(to.step);
    for (int axis = 0; axis < 3; ++axis) {
      const double k = std::round(place[axis]);
      if (!(std::abs(place[axis] - k) <= kTolerance && std::abs(k) <= kFarthest)) return false;
      to.values[static_cast<std::size_t>(3 * v + axis)] = static_cast<std::int32_t>(k);
      extent = std::max(extent, std::abs(k));
    }
  }
  return extent > 0;  // a mesh far smaller than a step is no point
}

}  // namespace

PagePositions page_positions(Vec3View positions, const Vec3& spacing) {
  PagePositions to;
  if (positions.empty()) return to;
  to.values.resize(static_cast<std::size_t>(3 * positions.size));
  to.origin = positions[0];
  to.step = spacing;
  to.lattice = find_lattice(positions, to);
  if (to.lattice) return to;
  const auto all = positions.matrix();
  // Halves first: the sum of the largest doubles is infinite.
  const Vec3 low = 0.5 * all.rowwise().minCoeff(), high = 0.5 * all.rowwise().maxCoeff();
  to.origin = low + high;
  const double half = (high - low).maxCoeff();
  to.step.setConstant(half > 0 ? std::ldexp(1., std::min(std::ilogb(half) + 1, 1023)) : 1.);
  for (Index v = 0; v < positions.size; ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      to.values[static_cast<std::size_t>(3 * v + axis)] =
          bits_of((positions[v][axis] - to.origin[axis]) / to.step[axis]);
    }
  }
  return to;
}

PageValues page_values(std::span<const double> values) {
  PageValues to;
  double largest = 0;
  for (const double value : values) {
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  }
  // Most fields need no scale; the largest value of the others is brought to [1, 2).
  if (largest > 1e30 || (largest > 0 && largest < 1e-30)) to.exponent = std::ilogb(largest);
  constexpr double kBelow2 = 2. - 0x1p-23;  // 2 times 2^1023 would be infinite
  to.values.reserve(values.size());
  for (const double value : values) {
    const double scaled = std::ldexp(value, -to.exponent);
    const bool rounds_to_2 =
        std::isfinite(value) && to.exponent == 1023 && std::abs(scaled) > kBelow2;
    to.values.push_back(bits_of(rounds_to_2 ? std::copysign(kBelow2, scaled) : scaled));
  }
  return to;
}

std::vector<std::int32_t> page_normals(Vec3View normals) {
  std::vector<std::int32_t> to;
  to.reserve(static_cast<std::size_t>(2 * normals.size));
  for (Index f = 0; f < normals.size; ++f) {
    const Vec3 n = normals[f];
    double x = n[0], y = n[1];
    const double size = std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]);
    x /= size;
    y /= size;
    if (n[2] < 0) {  // the lower half of the octahedron is folded out
      const double folded_x = (1. - std::abs(y)) * (x < 0 ? -1. : 1.);
      y = (1. - std::abs(x)) * (y < 0 ? -1. : 1.);
      x = folded_x;
    }
    for (const double coordinate : {x, y}) {
      to.push_back(static_cast<std::int32_t>(std::lround(32767. * coordinate)));
    }
  }
  return to;
}

}  // namespace dsc::detail
