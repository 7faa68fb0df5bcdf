/// \file
/// \internal
/// What a page keeps of doubles, as integers for packing.h, each with the error it makes.
///
/// | what | kept as | error |
/// | --- | --- | --- |
/// | positions on a lattice | integers k, x = origin + step · k per axis | 1e-9 steps |
/// | other positions | floats f, x = origin + step · f, the centre and a power of 2 | 2^-24 steps;
/// a step is at most twice half the mesh's largest extent |
/// | values | floats of value · 2^-exponent, one exponent a field | 2^-24 of the value; 1e-15 of
/// the largest finite one where that is more |
/// | unit normals | two 16-bit octahedral coordinates | 1e-4 radians |
///
/// A float is kept as the integer that its bits are.
#pragma once

#include "libdsc/base/types.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace dsc::detail {

struct PagePositions {
  bool lattice = false;
  Vec3 origin = Vec3::Zero();        ///< the lattice's, or the centre
  Vec3 step{1., 1., 1.};             ///< of the lattice, or the scale of the floats
  std::vector<std::int32_t> values;  ///< 3 a vertex
};

/// Positions on a lattice of this spacing where they all are, else as floats. \pre finite.
PagePositions page_positions(Vec3View positions, const Vec3& spacing);

struct PageValues {
  int exponent = 0;
  std::vector<std::int32_t> values;
};

/// \pre no NaN; infinities stay.
PageValues page_values(std::span<const double> values);

/// Two integers in [-32767, 32767] a normal. \pre unit vectors.
std::vector<std::int32_t> page_normals(Vec3View normals);

}  // namespace dsc::detail
