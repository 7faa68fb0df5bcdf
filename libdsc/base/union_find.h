/// \file
/// Disjoint sets that several threads may join at once.
#pragma once

#include "libdsc/base/types.h"

#include <atomic>
#include <cstddef>
#include <vector>

namespace dsc {

/// Sets over 0 … n-1. The root of a set is its smallest member once all joins are done, so labels
/// do not depend on the order of the joins, nor on threads.
class UnionFind {
 public:
  /// n sets of one member each; n at most 2^31 - 1.
  explicit UnionFind(Index n) : parent_(static_cast<std::size_t>(n)) {
    for (Index i = 0; i < n; ++i) parent_[static_cast<std::size_t>(i)] = static_cast<VertexId>(i);
  }

  /// The root of the set of i; halves the path to it on the way.
  VertexId find(VertexId i) {
    for (;;) {
      const VertexId p = load(i);
      if (p == i) return i;
      const VertexId grandparent = load(p);
      if (grandparent != p) at(i).store(grandparent, std::memory_order_relaxed);  // halve the path
      i = grandparent;
    }
  }

  /// Makes one set of those of a and b.
  void join(VertexId a, VertexId b) {
    if (load(a) == load(b)) return;  // the usual case, and sets never part
    for (;;) {
      a = find(a);
      b = find(b);
      if (a == b) return;
      if (a < b) std::swap(a, b);
      // The larger root goes under the smaller one, unless another thread has moved it meanwhile.
      VertexId expected = a;
      if (at(a).compare_exchange_strong(expected, b, std::memory_order_relaxed)) return;
    }
  }

 private:
  std::atomic_ref<VertexId> at(VertexId i) {
    return std::atomic_ref<VertexId>(parent_[static_cast<std::size_t>(i)]);
  }
  VertexId load(VertexId i) { return at(i).load(std::memory_order_relaxed); }

  std::vector<VertexId> parent_;
};

}  // namespace dsc
