/// \file
/// The parallel loops of libdsc: chunks of fixed size, ordered reduction, cancellation.
///
/// The cut into chunks depends on the problem size alone and partial results are joined in chunk
/// order, so every result is the same bits for any thread count. Two back ends: oneTBB, and
/// std::thread for ThreadSanitizer builds (DSC_PARALLEL=TBB|STD).
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/base/types.h"

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

namespace dsc {

/// The number of threads a run gets: its own wish, or one per core.
int thread_count(const Context& context);

namespace detail {

/// Calls task(c) for every c in [0, chunks), checking for cancellation before each.
/// \throws what the task of the lowest-numbered failing chunk threw, or Cancelled.
void run_chunks(const Context& context, Index chunks, const std::function<void(Index)>& task);

}  // namespace detail

/// Runs a task of a library that has parallel loops on the same back end, so that they take no more
/// threads than this run gets. Where the back end is another one, the library minds itself.
void run_within(const Context& context, const std::function<void()>& task);

/// Calls body(first, last) on consecutive ranges of at most `grain` indices that cover [0, n).
template <class Body>
void parallel_for(const Context& context, Index n, Index grain, Body&& body) {
  const Index chunks = (n + grain - 1) / grain;
  detail::run_chunks(context, chunks,
                     [&](Index c) { body(c * grain, std::min(n, (c + 1) * grain)); });
}

/// Joins body(first, last) over the same ranges in ascending order: join(join(init, r0), r1) ….
template <class T, class Body, class Join>
T parallel_reduce(const Context& context, Index n, Index grain, T init, Body&& body, Join&& join) {
  const Index chunks = (n + grain - 1) / grain;
  std::vector<T> partial(static_cast<std::size_t>(chunks), init);
  detail::run_chunks(context, chunks, [&](Index c) {
    partial[static_cast<std::size_t>(c)] = body(c * grain, std::min(n, (c + 1) * grain));
  });
  T result = std::move(init);
  for (T& p : partial) result = join(std::move(result), std::move(p));
  return result;
}

}  // namespace dsc
