/// \file
/// Overflow-checked sizes: multiply first, allocate afterwards.
#pragma once

#include "libdsc/base/error.h"
#include "libdsc/base/types.h"

#include <limits>
#include <string>

namespace dsc {

/// a * b for a, b >= 0. \throws LimitError naming `what` where the product passes 64 bits.
inline Index checked_product(Index a, Index b, const char* what) {
  Index product = 0;
  if (a < 0 || b < 0 || __builtin_mul_overflow(a, b, &product)) {
    throw LimitError(std::string(what) + ": " + std::to_string(a) + " x " + std::to_string(b) +
                     " is more than 64 bits can count");
  }
  return product;
}

/// `count` as a vertex id. \throws LimitError naming `what` where it passes 31 bits.
inline VertexId checked_id(Index count, const char* what) {
  if (count < 0 || count > std::numeric_limits<VertexId>::max()) {
    throw LimitError(std::string(what) + ": " + std::to_string(count) +
                     " is more than 32-bit ids can number; use a coarser grid or a part");
  }
  return static_cast<VertexId>(count);
}

/// Refuses an allocation that the machine cannot hold: systems grant more memory than there is and
/// kill the process later, so an allocation alone is no test. \throws LimitError naming `what`.
void check_allocation(Index bytes, const std::string& what);

}  // namespace dsc
