/// \file
/// How a long computation is run: on how many threads, watched and cancelled by whom, in how
/// much memory.
///
/// Every long function takes a `const Context&` as its last argument. There is no global state, so
/// two computations may run side by side with different settings.
#pragma once

#include "libdsc/base/error.h"
#include "libdsc/base/types.h"

#include <atomic>
#include <string_view>

namespace dsc {

/// Receives progress and carries the request to stop. The default reports nothing.
class Monitor {
 public:
  Monitor() = default;
  Monitor(const Monitor&) = delete;
  Monitor& operator=(const Monitor&) = delete;
  virtual ~Monitor() = default;

  /// A stage of `total` units begins; called from the thread that runs the algorithm.
  virtual void begin(std::string_view /*stage*/, Index /*total*/) {}
  /// `units` more are done; called from any thread.
  virtual void advance(Index /*units*/) noexcept {}

  /// Asks the computation to stop at its next chunk. Safe from any thread and from a signal
  /// handler.
  void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }
  /// Whether cancel() has been called.
  bool cancelled() const noexcept { return cancelled_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> cancelled_{false};
  static_assert(std::atomic<bool>::is_always_lock_free);
};

/// Bounds the memory of a computation; io/memory_limit.h has the one of a whole process. Each stage
/// asks for what it will take beside what is held already, before it takes it: systems grant more
/// memory than there is, and kill the process later.
class MemoryLimit {
 public:
  MemoryLimit() = default;
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;
  virtual ~MemoryLimit() = default;

  /// A stage is about to take `bytes` more, by its estimate. Called from any thread.
  /// \throws LimitError naming the stage, what it needs and what is allowed.
  virtual void need(std::string_view stage, Index bytes) const = 0;
  /// The bytes that a stage may still take.
  virtual Index left() const = 0;
};

/// Settings of a run. Results never depend on `threads`.
struct Context {
  int threads = 0;                      ///< 0: one per core
  Monitor* monitor = nullptr;           ///< not owned; may be null
  const MemoryLimit* memory = nullptr;  ///< not owned; null: no limit

  /// Tells the monitor, where there is one.
  /// @{
  void begin(std::string_view stage, Index total = 0) const {
    if (monitor != nullptr) monitor->begin(stage, total);
  }
  void advance(Index units) const noexcept {
    if (monitor != nullptr) monitor->advance(units);
  }
  /// @}
  /// \throws LimitError where the limit does not leave the bytes that a stage will take.
  void need(std::string_view stage, Index bytes) const {
    if (memory != nullptr) memory->need(stage, bytes);
  }
  /// \throws Cancelled where the monitor has been asked to stop.
  void check() const {
    if (monitor != nullptr && monitor->cancelled()) throw Cancelled();
  }
};

}  // namespace dsc
