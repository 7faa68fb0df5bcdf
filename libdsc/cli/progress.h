/// \file
/// A progress bar on a terminal: one line of stderr, redrawn at most ten times a second,
/// with the time that the stage still takes at its speed so far.
#pragma once

#include "libdsc/base/context.h"

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>

namespace dsc::cli {

/// Draws only where it is told that it may; carries the request to stop in any case. The first
/// line appears after a fifth of a second, so that quick runs show nothing.
class ProgressBar final : public Monitor {
 public:
  explicit ProgressBar(bool draw);
  ~ProgressBar() override { clear(); }

  void begin(std::string_view stage, Index total) override;
  void advance(Index units) noexcept override;

  /// Removes the bar from the terminal, before other text is printed.
  void clear() noexcept;

 private:
  void draw_if_due() noexcept;

  const bool draw_;
  std::atomic<Index> done_{0};
  std::atomic<Index> total_{0};
  std::atomic<std::int64_t> begun_{0};  ///< when the stage began, in ms
  const std::int64_t first_;            ///< when the bar may appear, in ms
  std::atomic<std::int64_t> due_;       ///< when to draw next, steady clock, milliseconds
  std::mutex mutex_;                    ///< guards what follows
  std::string stage_;
  bool visible_ = false;
};

}  // namespace dsc::cli
