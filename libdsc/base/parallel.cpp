#include "libdsc/base/parallel.h"

#include <exception>
#include <limits>
#include <mutex>
#include <thread>

#ifdef DSC_PARALLEL_TBB
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#endif

namespace dsc {

int thread_count(const Context& context) {
  if (context.threads > 0) return context.threads;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

namespace detail {
namespace {

/// Runs chunks and keeps the exception of the lowest chunk that failed. Chunks below that one still
/// run, so which exception is reported does not depend on the schedule.
class Guard {
 public:
  Guard(const Context& context, const std::function<void(Index)>& task) : context_(context), task_(task) {}

  void operator()(Index chunk) {
    if (chunk > failed_.load(std::memory_order_relaxed)) return;
    try {
      context_.check();
      task_(chunk);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (chunk < failed_.load(std::memory_order_relaxed)) {
        failed_.store(chunk, std::memory_order_relaxed);
        error_ = std::current_exception();
      }
    }
  }

  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  const Context& context_;
  const std::function<void(Index)>& task_;
  std::atomic<Index> failed_{std::numeric_limits<Index>::max()};
  std::mutex mutex_;
  std::exception_ptr error_;
};

#ifdef DSC_PARALLEL_TBB

void dispatch(int threads, Index chunks, Guard& guard) {
  oneapi::tbb::task_arena arena(threads);
  arena.execute([&] { oneapi::tbb::parallel_for(Index{0}, chunks, [&](Index c) { guard(c); }); });
}

#else

void dispatch(int threads, Index chunks, Guard& guard) {
  std::atomic<Index> next{0};
  const auto work = [&] {
    for (Index c = next.fetch_add(1); c < chunks; c = next.fetch_add(1)) guard(c);
  };
  std::vector<std::thread> helpers;
  const int extra = static_cast<int>(std::min<Index>(threads, chunks)) - 1;
  for (int i = 0; i < extra; ++i) helpers.emplace_back(work);
  work();
  for (std::thread& helper : helpers) helper.join();
}

#endif

}  // namespace

void run_chunks(const Context& context, Index chunks, const std::function<void(Index)>& task) {
  Guard guard(context, task);
  const int threads = thread_count(context);
  if (threads == 1 || chunks <= 1) {
    for (Index c = 0; c < chunks; ++c) guard(c);
  } else {
    dispatch(threads, chunks, guard);
  }
  guard.rethrow();
}

}  // namespace detail
}  // namespace dsc
