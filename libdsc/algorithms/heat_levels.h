/// \file
/// \internal
/// The vertices that heat reaches from its sources, numbered by breadth-first level.
#pragma once

#include "libdsc/base/types.h"

#include <algorithm>
#include <span>
#include <vector>

namespace dsc {

/// Level 0 is the free sources; level l + 1 the free vertices that level l is the first to couple
/// with. A position is a place in `order`.
struct HeatLevels {
  std::vector<VertexId> order;  ///< vertices by level
  std::vector<Index> starts;    ///< of each level in `order`, and the end
  std::vector<VertexId> place;  ///< V: the position of each vertex, or -1

  Index count() const { return static_cast<Index>(starts.size()) - 1; }
  /// The first position of `level`; that of the end for levels beyond the last.
  Index start(Index level) const {
    return starts[static_cast<std::size_t>(std::min(level, count()))];
  }
  VertexId vertex(Index position) const { return order[static_cast<std::size_t>(position)]; }
  Index position(Index vertex) const { return place[static_cast<std::size_t>(vertex)]; }
};

/// `A` symmetric, both triangles; vertices with `fixed` != 0 (V flags, or empty) are left out.
/// \throws UsageError where a source is out of range.
HeatLevels heat_levels(const SparseMatrix& A, std::span<const VertexId> sources,
                       std::span<const char> fixed = {});

}  // namespace dsc
