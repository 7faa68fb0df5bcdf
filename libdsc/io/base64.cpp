#include "libdsc/io/base64.h"

#include <array>

namespace dsc::detail {
namespace {

/// Two base64 digits for each of the 4096 values of 12 bits.
const std::array<std::array<char, 2>, 4096>& digit_pairs() {
  static const auto table = [] {
    const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<std::array<char, 2>, 4096> pairs{};
    for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i] = {digits[i >> 6], digits[i & 63]};
    return pairs;
  }();
  return table;
}

}  // namespace

void append_base64(std::string& out, std::string_view bytes) {
  const auto& pairs = digit_pairs();
  const auto* p = reinterpret_cast<const unsigned char*>(bytes.data());
  const std::size_t whole = bytes.size() / 3;
  const std::size_t start = out.size();
  out.resize(start + (bytes.size() + 2) / 3 * 4);
  char* to = out.data() + start;
  for (std::size_t i = 0; i < whole; ++i, p += 3, to += 4) {
    const unsigned bits =
        static_cast<unsigned>(p[0]) << 16 | static_cast<unsigned>(p[1]) << 8 | p[2];
    const auto& high = pairs[bits >> 12];
    const auto& low = pairs[bits & 4095];
    to[0] = high[0];
    to[1] = high[1];
    to[2] = low[0];
    to[3] = low[1];
  }
  const std::size_t rest = bytes.size() - 3 * whole;
  if (rest > 0) {
    const unsigned bits =
        static_cast<unsigned>(p[0]) << 16 | (rest == 2 ? static_cast<unsigned>(p[1]) << 8 : 0U);
    const auto& high = pairs[bits >> 12];
    const auto& low = pairs[bits & 4095];
    to[0] = high[0];
    to[1] = high[1];
    to[2] = rest == 2 ? low[0] : '=';
    to[3] = '=';
  }
}

}  // namespace dsc::detail
