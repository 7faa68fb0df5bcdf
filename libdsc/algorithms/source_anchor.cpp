#include "libdsc/algorithms/source_anchor.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace dsc {
namespace {

bool hotter(const WideVector& w, Index a, Index b) {
  const double ma = w.mantissa(a), mb = w.mantissa(b);
  if (ma <= 0 || mb <= 0) return std::max(ma, 0.) > std::max(mb, 0.);
  return w.exponent(a) != w.exponent(b) ? w.exponent(a) > w.exponent(b) : ma > mb;
}

}  // namespace

void anchor_sources(Eigen::VectorXd& phi, const SparseMatrix& L, const WideVector& w,
                    std::span<const VertexId> sources) {
  const auto n = static_cast<std::size_t>(phi.size());
  // Nearest first, by heat. Exponents above, mantissas below: both are normalised.
  std::vector<VertexId> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](VertexId a, VertexId b) { return hotter(w, a, b) || (!hotter(w, b, a) && a < b); });
  std::vector<VertexId> source(n, -1);
  for (const VertexId s : sources) source[static_cast<std::size_t>(s)] = s;
  // A local maximum of w that is no source can only come from rounding or an obtuse corner of the
  // calculus: it waits for a neighbour that has one, which breadth-first rounds give it.
  std::vector<VertexId> waiting;
  for (const VertexId v : order) {
    VertexId& mine = source[static_cast<std::size_t>(v)];
    if (mine >= 0) continue;
    Index best = v;
    for (SparseMatrix::InnerIterator it(L, v); it; ++it) {
      if (source[static_cast<std::size_t>(it.row())] >= 0 &&
          (best == v || hotter(w, it.row(), best))) {
        best = it.row();
      }
    }
    if (best != v) {
      mine = source[static_cast<std::size_t>(best)];
    } else {
      waiting.push_back(v);
    }
  }
  for (bool progress = true; progress && !waiting.empty();) {
    progress = false;
    std::vector<VertexId> still;
    for (const VertexId v : waiting) {
      VertexId found = -1;
      for (SparseMatrix::InnerIterator it(L, v); it && found < 0; ++it) {
        found = source[static_cast<std::size_t>(it.row())];
      }
      if (found >= 0) {
        source[static_cast<std::size_t>(v)] = found;
        progress = true;
      } else {
        still.push_back(v);
      }
    }
    waiting.swap(still);
  }
  const Eigen::VectorXd original = phi;
  for (std::size_t v = 0; v < n; ++v) {
    if (source[v] >= 0) phi[static_cast<Index>(v)] -= original[source[v]];
  }
}

}  // namespace dsc
