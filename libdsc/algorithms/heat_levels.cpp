#include "libdsc/algorithms/heat_levels.h"

#include "libdsc/base/error.h"

#include <string>

namespace dsc {

HeatLevels heat_levels(const SparseMatrix& A, std::span<const VertexId> sources,
                       std::span<const char> fixed) {
  HeatLevels l;
  l.order.reserve(static_cast<std::size_t>(A.rows()));
  l.place.assign(static_cast<std::size_t>(A.rows()), -1);
  const auto visit = [&](VertexId v) {
    auto& place = l.place[static_cast<std::size_t>(v)];
    if (place >= 0 || (!fixed.empty() && fixed[static_cast<std::size_t>(v)] != 0)) return;
    place = static_cast<VertexId>(l.order.size());
    l.order.push_back(v);
  };
  for (const VertexId s : sources) {
    if (s < 0 || s >= A.rows()) {
      throw UsageError("heat: there is no vertex " + std::to_string(s) + " to start from");
    }
    visit(s);
  }
  l.starts.push_back(0);
  for (std::size_t first = 0; first < l.order.size();) {
    const std::size_t last = l.order.size();
    l.starts.push_back(static_cast<Index>(last));
    for (std::size_t i = first; i < last; ++i) {
      for (SparseMatrix::InnerIterator it(A, l.order[i]); it; ++it) {
        visit(static_cast<VertexId>(it.row()));
      }
    }
    first = last;
  }
  return l;
}

}  // namespace dsc
