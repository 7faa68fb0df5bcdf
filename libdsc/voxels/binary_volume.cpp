#include "libdsc/voxels/binary_volume.h"

#include <bit>
#include <new>
#include <string>

namespace dsc {

Index BinaryVolume::bytes_for(const Grid& grid) {
  grid.check();
  const Index slice =
      checked_product((grid.size[0] + 2 + 63) / 64, grid.size[1] + 2, "volume slice");
  const Index words = checked_product(slice, grid.size[2] + 2, "volume words");
  return checked_product(words + 2 * kSlack, sizeof(Word), "volume bytes");
}

BinaryVolume::BinaryVolume(const Grid& grid) : grid_(grid) {
  const Index bytes = bytes_for(grid);
  check_allocation(bytes, "volume: " + grid.text());
  words_per_row_ = (grid.size[0] + 2 + 63) / 64;
  word_stride_ = grid.size[1] + 2;
  slice_stride_ = words_per_row_ * word_stride_;
  try {
    words_.assign(static_cast<std::size_t>(bytes) / sizeof(Word), Word{0});
  } catch (const std::exception&) {  // bad_alloc or length_error
    throw LimitError("volume: no memory for the " + grid.text());
  }
}

Index BinaryVolume::count() const {
  Index total = 0;
  for (const Word w : words_) total += std::popcount(w);
  return total;
}

}  // namespace dsc
