/// \file
/// \internal
/// The order of a few numbers, found without a branch on their values.
#pragma once

#include "libdsc/base/types.h"

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>

namespace dsc {

/// Sorts up to kMost numbers, equal ones once, and tells where each one went. Every number is
/// compared with every other, several at a time by vector instructions: for a dozen numbers in no
/// special order that is faster than an insertion, which the processor guesses wrong at every step.
class SmallRanks {
 public:
  static constexpr std::size_t kMost = 32;

  void clear() { count_ = 0; }
  /// At most kMost times. Not negative, and less than the largest number there is.
  void push(VertexId v) { numbers_[count_++] = v; }

  void sort() {
    const std::size_t end = (count_ + kLanes - 1) / kLanes * kLanes;
    for (std::size_t i = count_; i < end; ++i) numbers_[i] = std::numeric_limits<VertexId>::max();
    std::uint32_t taken = 0;
    for (std::size_t first = 0; first < end; first += kLanes) {
      using Lanes = Eigen::Array<VertexId, kLanes, 1>;
      const Lanes lanes = Eigen::Map<const Lanes>(numbers_.data() + first);
      Lanes less = Lanes::Zero();
      // Neither is negative, so that the difference fits: -1 where it is below zero, or 0.
      for (std::size_t j = 0; j < count_; ++j) {
        less -= (numbers_[j] - lanes).template shiftRight<31>();
      }
      Eigen::Map<Lanes>(less_.data() + first) = less;
    }
    for (std::size_t i = 0; i < count_; ++i) {
      by_less_[static_cast<std::size_t>(less_[i])] = numbers_[i];  // equal ones to one place
      taken |= std::uint32_t{1} << less_[i];
    }
    std::size_t rank = 0;
    for (; taken != 0; taken &= taken - 1) {
      const auto place = static_cast<std::size_t>(std::countr_zero(taken));
      rank_[place] = static_cast<std::uint8_t>(rank);
      sorted_[rank++] = by_less_[place];
    }
    distinct_ = rank;
  }

  /// The numbers, ascending, each once.
  std::span<const VertexId> sorted() const { return {sorted_.data(), distinct_}; }
  /// Where in sorted() the number that was pushed as i-th is.
  std::uint8_t rank(std::size_t i) const { return rank_[static_cast<std::size_t>(less_[i])]; }

 private:
  static constexpr std::size_t kLanes = 8;

  std::size_t count_ = 0, distinct_ = 0;
  std::array<VertexId, kMost> numbers_, by_less_, sorted_;
  std::array<VertexId, kMost> less_;
  std::array<std::uint8_t, kMost> rank_;  ///< how many are less; ranks by that
};

}  // namespace dsc
