#include "libdsc/base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

namespace dsc {
namespace {

TEST(Parallel, EveryIndexIsVisitedOnce) {
  for (const int threads : {1, 2, 4, 8}) {
    std::vector<std::atomic<int>> visits(1003);
    parallel_for(Context{threads}, 1003, 10, [&](Index first, Index last) {
      for (Index i = first; i < last; ++i) ++visits[static_cast<std::size_t>(i)];
    });
    for (const auto& v : visits) EXPECT_EQ(v.load(), 1);
  }
}

TEST(Parallel, FloatingPointSumsDoNotDependOnThreads) {
  const auto sum = [](int threads) {
    return parallel_reduce(
        Context{threads}, 100001, 37, 0.0,
        [](Index first, Index last) {
          double s = 0;
          for (Index i = first; i < last; ++i) s += 1.0 / static_cast<double>(3 * i + 1);
          return s;
        },
        [](double a, double b) { return a + b; });
  };
  const double one = sum(1);
  for (const int threads : {2, 4, 8}) EXPECT_EQ(one, sum(threads));
}

TEST(Parallel, TheLowestFailingChunkIsReported) {
  for (const int threads : {1, 4}) {
    try {
      parallel_for(Context{threads}, 100, 1, [](Index first, Index) {
        if (first == 17 || first == 60) throw std::runtime_error(std::to_string(first));
      });
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& e) {
      EXPECT_STREQ(e.what(), "17");
    }
  }
}

TEST(Parallel, CancellationStopsBetweenChunks) {
  Monitor monitor;
  std::atomic<int> chunks{0};
  EXPECT_THROW(parallel_for(Context{1, &monitor}, 100, 1,
                            [&](Index first, Index) {
                              ++chunks;
                              if (first == 4) monitor.cancel();
                            }),
               Cancelled);
  EXPECT_EQ(chunks.load(), 5);
}

}  // namespace
}  // namespace dsc
