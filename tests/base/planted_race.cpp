// A program with a data race in the body of a parallel loop: ThreadSanitizer has to report it, or a
// clean run of the tests under it would mean nothing.
#include "libdsc/base/parallel.h"

#include <atomic>
#include <cstdio>
#include <thread>

int main() {
  int shared = 0;
  std::atomic<int> arrived{0};
  dsc::parallel_for(dsc::Context{2}, 2, 1, [&](dsc::Index, dsc::Index) {
    // Both chunks are under way at once; relaxed, so that this orders nothing.
    arrived.fetch_add(1, std::memory_order_relaxed);
    while (arrived.load(std::memory_order_relaxed) < 2) std::this_thread::yield();
    ++shared;
  });
  std::printf("%d\n", shared);
  return 0;
}
