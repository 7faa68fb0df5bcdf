#include "libdsc/calculus/small_ranks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace dsc {
namespace {

/// Sorted by the standard library, for every count, with many and with few equal numbers, and with
/// the least and the greatest that are allowed.
TEST(SmallRanks, AreThoseOfSortedDistinctNumbers) {
  constexpr VertexId kGreatest = std::numeric_limits<VertexId>::max() - 1;
  std::mt19937 random(5);
  SmallRanks ranks;
  for (std::size_t count = 0; count <= SmallRanks::kMost; ++count) {
    for (const VertexId most : {3, 20, kGreatest}) {
      std::uniform_int_distribution<VertexId> number(0, most);
      std::vector<VertexId> pushed(count);
      for (VertexId& v : pushed) v = number(random);
      if (count > 2) {
        pushed[count / 2] = 0;
        pushed[count / 3] = kGreatest;
      }
      ranks.clear();
      for (const VertexId v : pushed) ranks.push(v);
      ranks.sort();

      std::vector<VertexId> sorted = pushed;
      std::sort(sorted.begin(), sorted.end());
      sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
      ASSERT_TRUE(std::ranges::equal(ranks.sorted(), sorted)) << count << " numbers to " << most;
      for (std::size_t i = 0; i < count; ++i) {
        ASSERT_EQ(ranks.sorted()[ranks.rank(i)], pushed[i]) << i << " of " << count;
      }
    }
  }
}

}  // namespace
}  // namespace dsc
