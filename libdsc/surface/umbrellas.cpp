#include "libdsc/surface/umbrellas.h"

#include "libdsc/base/parallel.h"

#include <atomic>
#include <limits>

namespace dsc::topology {
namespace {

bool is_leader(SideCode corner, Opposite opposite) {
  const SideCode previous = previous_around(corner, opposite);
  if (previous == kNoSide) return true;
  if (previous < corner) return false;
  for (SideCode c = next_around(corner, opposite); c != corner; c = next_around(c, opposite)) {
    if (c < corner) return false;  // kNoSide, a chain's end, is less than any corner
  }
  return true;
}

VertexId pointel(std::span<const QuadCorners> corners, SideCode corner) {
  return corners[static_cast<std::size_t>(face_of(corner))][static_cast<std::size_t>(corner & 3)];
}

}  // namespace

SideCode leader_of(SideCode corner, Opposite opposite) {
  SideCode least = corner;
  for (SideCode c = next_around(corner, opposite); c != corner; c = next_around(c, opposite)) {
    if (c == kNoSide) {
      SideCode start = corner;
      for (SideCode p = start; p != kNoSide; p = previous_around(p, opposite)) start = p;
      return start;
    }
    least = std::min(least, c);
  }
  return least;
}

Umbrellas find_umbrellas(std::span<const QuadCorners> corners, Opposite opposite, Index vertices,
                         const Context& context) {
  constexpr SideCode kUnset = std::numeric_limits<SideCode>::max();
  constexpr Index kGrain = 8192;
  Umbrellas result;
  result.first.assign(static_cast<std::size_t>(vertices), kUnset);
  // All leaders of a pointel but the smallest lose exactly one comparison, whatever the order.
  const auto faces = static_cast<Index>(corners.size());
  std::vector<std::vector<SideCode>> losers(
      static_cast<std::size_t>((faces + kGrain - 1) / kGrain));
  parallel_for(context, faces, kGrain, [&](Index begin, Index end) {
    auto& lost = losers[static_cast<std::size_t>(begin / kGrain)];
    for (auto corner = side_code(begin, 0); corner < side_code(end, 0); ++corner) {
      if (!is_leader(corner, opposite)) continue;
      const std::atomic_ref<SideCode> first(
          result.first[static_cast<std::size_t>(pointel(corners, corner))]);
      SideCode seen = first.load(std::memory_order_relaxed);
      while (corner < seen &&
             !first.compare_exchange_weak(seen, corner, std::memory_order_relaxed)) {
      }
      if (seen != kUnset) lost.push_back(std::max(seen, corner));
    }
  });
  for (const auto& lost : losers) {
    result.further.insert(result.further.end(), lost.begin(), lost.end());
  }
  std::sort(result.further.begin(), result.further.end(), [&](SideCode a, SideCode b) {
    const VertexId p = pointel(corners, a), q = pointel(corners, b);
    return p != q ? p < q : a < b;
  });
  return result;
}

}  // namespace dsc::topology
