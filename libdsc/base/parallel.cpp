#include "libdsc/base/parallel.h"

#include <exception>
#include <limits>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>

#ifdef DSC_PARALLEL_TBB
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#endif

namespace dsc {

int thread_count(const Context& context) {
  if (context.threads > 0) return context.threads;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

#ifdef DSC_PARALLEL_TBB
namespace {

template <class Task>
void run_in_arena(int threads, const Task& task) {
  // More threads than cores only where they are asked for: tests do, to run chunks side by side.
  std::optional<oneapi::tbb::global_control> more;
  const auto kind = oneapi::tbb::global_control::max_allowed_parallelism;
  const auto wish = static_cast<std::size_t>(threads);
  if (wish > oneapi::tbb::global_control::active_value(kind)) more.emplace(kind, wish);
  oneapi::tbb::task_arena arena(threads);
  arena.execute(task);
}

}  // namespace
#endif

void run_within(const Context& context, const std::function<void()>& task) {
#ifdef DSC_PARALLEL_TBB
  run_in_arena(thread_count(context), task);
#else
  static_cast<void>(context);
  task();
#endif
}

namespace detail {
namespace {

/// Runs chunks and keeps the exception of the lowest chunk that failed. Chunks below that one still
/// run, so which exception is reported does not depend on the schedule.
class Guard {
 public:
  Guard(const Context& context, const std::function<void(Index)>& task)
      : context_(context), task_(task) {}

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
  run_in_arena(threads, [&] {
    oneapi::tbb::parallel_for(Index{0}, chunks, [&](Index c) { guard(c); });
  });
}

#else

void dispatch(int threads, Index chunks, Guard& guard) {
  // Relaxed: handing out chunks must not order them, or ThreadSanitizer would miss races between
  // chunks that happened to run one after the other.
  std::atomic<Index> next{0};
  const auto take = [&] { return next.fetch_add(1, std::memory_order_relaxed); };
  const auto work = [&] {
    for (Index c = take(); c < chunks; c = take()) guard(c);
  };
  const auto extra = static_cast<std::size_t>(std::min<Index>(threads, chunks) - 1);
  std::vector<std::jthread> helpers;  // joined at the end of the scope, however it ends
  helpers.reserve(extra);
  try {
    while (helpers.size() < extra) helpers.emplace_back(work);
  } catch (const std::system_error&) {
    // The system gives no more threads; those there are do all the chunks.
  }
  work();
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
