/// \file
/// \internal
/// How shapes fill a row of values fast: an inlined function over a word of 64 points.
#pragma once

#include "libdsc/base/types.h"

#include <charconv>
#include <string>

namespace dsc {

/// The shortest text that reads back as the same number.
inline std::string text_of(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, end.ptr};
}

namespace detail {

/// out[k] = f(step (first + k)); the constant trip count lets the compiler use vectors.
template <class F>
void fill_row(double step, Index first, int count, double* out, const F& f) {
  if (count == 64) {
    const double start = static_cast<double>(first);
    for (int k = 0; k < 64; ++k) out[k] = f(step * (start + static_cast<double>(k)));
  } else {
    for (int k = 0; k < count; ++k) out[k] = f(step * static_cast<double>(first + k));
  }
}

}  // namespace detail
}  // namespace dsc
