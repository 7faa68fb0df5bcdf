#include "libdsc/voxels/binary_volume.h"

#include <unistd.h>

#include <bit>
#include <cmath>
#include <new>
#include <string>

namespace dsc {
namespace {

/// Keeps sizes with their margins, in doubled coordinates too, far from overflow.
constexpr Index kLongestAxis = Index{1} << 40;

/// Bytes of memory that the machine has; 0 where it does not say. Systems grant more than that and
/// kill the process later, so an allocation alone is no test.
Index physical_memory() {
  const long pages = ::sysconf(_SC_PHYS_PAGES);
  const long bytes = ::sysconf(_SC_PAGESIZE);
  return pages > 0 && bytes > 0 ? static_cast<Index>(pages) * bytes : 0;
}

}  // namespace

BinaryVolume::BinaryVolume(const Grid& grid) : grid_(grid) {
  for (int axis = 0; axis < 3; ++axis) {
    if (grid.size[axis] < 0) {
      throw InputError("volume: negative size " + std::to_string(grid.size[axis]) + " along axis " +
                       std::to_string(axis));
    }
    if (grid.size[axis] > kLongestAxis) {
      throw LimitError("volume: " + std::to_string(grid.size[axis]) + " voxels along axis " +
                       std::to_string(axis) + " are more than 2^40");
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
  const Index bytes = checked_product(words, sizeof(Word), "volume bytes");
  if (const Index memory = physical_memory(); memory > 0 && bytes > memory) {
    throw LimitError("volume: " + std::to_string(grid.size[0]) + " x " +
                     std::to_string(grid.size[1]) + " x " + std::to_string(grid.size[2]) +
                     " voxels need " + std::to_string(bytes >> 20) + " MiB, the machine has " +
                     std::to_string(memory >> 20) + "; use a coarser grid or a part");
  }
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
