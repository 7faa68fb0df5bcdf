#include "libdsc/normals/row_scan.h"

#include <bit>

namespace dsc {

RowSums scan_row(const BinaryVolume& volume, Index low, Index high, Index y, Index z, Index cx) {
  RowSums sums;
  const Index first_word = (low + 1) >> 6;
  const Index last_word = (high + 1) >> 6;
  for (Index w = first_word; w <= last_word; ++w) {
    BinaryVolume::Word bits = volume.word(w, y, z);
    if (w == first_word) bits &= ~BinaryVolume::Word{0} << ((low + 1) & 63);
    if (w == last_word) bits &= ~BinaryVolume::Word{0} >> (63 - ((high + 1) & 63));
    while (bits != 0) {
      const int start = std::countr_zero(bits);
      const int length = std::countr_one(bits >> start);
      add_run(sums, 2 * (64 * w + start - 1) - cx, length);
      if (start + length == 64) break;
      bits &= ~BinaryVolume::Word{0} << (start + length);
    }
  }
  return sums;
}

}  // namespace dsc
