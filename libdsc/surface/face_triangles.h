/// \file
/// A face as triangles, for forms that know of nothing else: a quad is cut along its shorter
/// diagonal, a larger face into a fan from its first corner.
#pragma once

#include "libdsc/surface/flat_mesh.h"

#include <cstddef>

namespace dsc {

/// Calls take(a, b, c) with the corners of each triangle of face f, numbered within the face from
/// 0, in the face's sense of rotation: n - 2 triangles of n corners, none of fewer than three. Of
/// equal diagonals that of the first corner is taken.
template <class Take>
void for_each_triangle(const FlatMesh& mesh, Index f, const Take& take) {
  const auto corners = mesh.face(f);
  const std::size_t n = corners.size();
  const auto at = [&](std::size_t i) { return mesh.positions[corners[i]]; };
  const bool turned = n == 4 && (at(1) - at(3)).squaredNorm() < (at(0) - at(2)).squaredNorm();
  const std::size_t start = turned ? 1 : 0;
  for (std::size_t i = 1; i + 1 < n; ++i) take(start, (start + i) % n, (start + i + 1) % n);
}

}  // namespace dsc
