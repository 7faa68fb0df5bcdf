/// \file
/// Counting bits without a call.
#pragma once

#include <bit>
#include <cstdint>

namespace dsc {

/// The number of ones. std::popcount is one instruction where the build may use it, and a call of
/// the compiler's library in a portable build, which costs more than these few operations.
inline int count_bits(std::uint64_t v) {
#ifdef __POPCNT__
  return std::popcount(v);
#else
  v -= v >> 1 & 0x5555555555555555U;
  v = (v & 0x3333333333333333U) + (v >> 2 & 0x3333333333333333U);
  v = (v + (v >> 4)) & 0x0f0f0f0f0f0f0f0fU;
  return static_cast<int>(v * 0x0101010101010101U >> 56);
#endif
}

}  // namespace dsc
