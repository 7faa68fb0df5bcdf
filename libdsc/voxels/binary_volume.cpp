#include "libdsc/voxels/binary_volume.h"

#include <bit>
#include <new>
#include <string>

namespace dsc {
BinaryVolume::BinaryVolume(const Grid& grid) : grid_(grid) {
  grid.check();
  words_per_row_ = (grid.size[0] + 2 + 63) / 64;
  word_stride_ = grid.size[1] + 2;
  slice_stride_ = checked_product(words_per_row_, word_stride_, "volume slice");
  const Index words = checked_product(slice_stride_, grid.size[2] + 2, "volume words");
  const Index bytes = checked_product(words, sizeof(Word), "volume bytes");
  check_allocation(bytes, "volume: " + grid.text());
  try {
    words_.assign(static_cast<std::size_t>(words + 2 * kSlack), Word{0});
  } catch (const std::exception&) {  // bad_alloc or length_error
    throw LimitError("volume: no memory for " + std::to_string(words) + " words of 64 voxels");
  }
}

Index BinaryVolume::count() const {
  Index total = 0;
  for (const Word w : words_) total += std::popcount(w);
  return total;
}

}  // namespace dsc
