#include "libdsc/voxels/binary_volume.h"

#include <bit>
#include <cmath>
#include <new>
#include <string>

namespace dsc {

BinaryVolume::BinaryVolume(const Grid& grid) : grid_(grid) {
  for (int axis = 0; axis < 3; ++axis) {
    if (grid.size[axis] < 0) {
      throw InputError("volume: negative size " + std::to_string(grid.size[axis]) + " along axis " +
                       std::to_string(axis));
    }
    if (!(grid.spacing[axis] > 0) || !std::isfinite(grid.spacing[axis]) ||
        !std::isfinite(grid.origin[axis])) {
      throw InputError("volume: the spacing must be positive and finite, the origin finite; axis " +
                       std::to_string(axis) + " has spacing " + std::to_string(grid.spacing[axis]));
    }
  }
  (void)grid.voxels();
  words_per_row_ = (grid.size[0] + 2 + 63) / 64;
  word_stride_ = grid.size[1] + 2;
  slice_stride_ = checked_product(words_per_row_, word_stride_, "volume slice");
  const Index words = checked_product(slice_stride_, grid.size[2] + 2, "volume words");
  (void)checked_product(words, sizeof(Word), "volume bytes");
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
