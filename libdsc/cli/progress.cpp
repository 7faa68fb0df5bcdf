#include "libdsc/cli/progress.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace dsc::cli {
namespace {

std::int64_t now_ms() {
  using namespace std::chrono;
  return duration_cast<milliseconds>(steady_clock::now().time_since_epoch()).count();
}

/// What a stage still takes that has done `fraction` of its work in `ms`; empty where a guess would
/// be worth nothing yet.
std::string time_left(double fraction, std::int64_t ms) {
  if (ms < 1000 || fraction < 0.02) return "";
  const auto left = static_cast<long>(1e-3 * static_cast<double>(ms) * (1 / fraction - 1) + 0.5);
  if (left < 100) return fmt::format(", {} s left", left);
  return fmt::format(", {}:{:02} min left", left / 60, left % 60);
}

/// A bar that cannot be drawn is no reason to fail.
void put(const char* text, std::size_t size) noexcept {
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text, size);
}

}  // namespace

ProgressBar::ProgressBar(bool draw) : draw_(draw), first_(now_ms() + 200), due_(first_) {}

void ProgressBar::begin(std::string_view stage, Index total) {
  if (!draw_) return;
  {
    const std::lock_guard lock(mutex_);
    stage_ = stage;
  }
  done_.store(0, std::memory_order_relaxed);
  total_.store(total, std::memory_order_relaxed);
  begun_.store(now_ms(), std::memory_order_relaxed);
  // At once: a stage that does not count its steps would run under the name of the one before it.
  if (now_ms() >= first_) due_.store(0, std::memory_order_relaxed);
  draw_if_due();
}

void ProgressBar::advance(Index units) noexcept {
  if (!draw_) return;
  done_.fetch_add(units, std::memory_order_relaxed);
  draw_if_due();
}

void ProgressBar::draw_if_due() noexcept {
  std::int64_t due = due_.load(std::memory_order_relaxed);
  const std::int64_t now = now_ms();
  if (now < due || !due_.compare_exchange_strong(due, now + 100, std::memory_order_relaxed)) return;
  const std::lock_guard lock(mutex_);
  const Index total = total_.load(std::memory_order_relaxed);
  const Index done = std::min(done_.load(std::memory_order_relaxed), total);
  char line[128];
  int size = 0;
  if (total > 0) {
    constexpr int kWidth = 40;
    const double fraction = static_cast<double>(done) / static_cast<double>(total);
    const int filled = static_cast<int>(fraction * kWidth);
    size = std::snprintf(line, sizeof line, "\r\033[K%-24.24s [%.*s%*s] %3.0f %%%s", stage_.c_str(),
                         filled, "########################################", kWidth - filled, "",
                         100. * fraction,
                         time_left(fraction, now - begun_.load(std::memory_order_relaxed)).c_str());
  } else {
    size = std::snprintf(line, sizeof line, "\r\033[K%-24.24s", stage_.c_str());
  }
  if (size > 0) put(line, static_cast<std::size_t>(size));
  visible_ = true;
}

void ProgressBar::clear() noexcept {
  const std::lock_guard lock(mutex_);
  if (visible_) put("\r\033[K", 4);
  visible_ = false;
}

}  // namespace dsc::cli
