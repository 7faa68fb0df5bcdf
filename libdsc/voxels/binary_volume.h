/// \file
/// A set of voxels, one bit each.
///
/// Bits run along x in words of 64; the words of neighbouring y are neighbours in memory, so that a
/// vector register holds several rows of a ball. A margin of one empty voxel surrounds the grid:
/// neighbours can be read without a bounds check. Reading outside the margin through operator()
/// gives false.
#pragma once

#include "libdsc/base/types.h"
#include "libdsc/voxels/grid.h"

#include <cstdint>
#include <vector>

namespace dsc {

/// Bits of a set of voxels on a grid; see the head of this file for their order.
class BinaryVolume {
 public:
  /// 64 voxels of a row.
  using Word = std::uint64_t;

  BinaryVolume() = default;
  /// All voxels empty. \throws InputError on a negative size or a spacing that is not positive and
  /// finite, LimitError on overflow or where memory does not suffice.
  explicit BinaryVolume(const Grid& grid);

  /// Size, spacing and origin.
  const Grid& grid() const { return grid_; }

  /// Whether voxel (x, y, z) is in the set; false anywhere outside the grid.
  bool operator()(Index x, Index y, Index z) const {
    if (!grid_.contains(x, y, z)) return false;
    const Index bit = x + 1;
    return (word(bit >> 6, y, z) >> (bit & 63) & 1) != 0;
  }

  /// The same without the bounds check, for voxels of the grid or of its margin of one voxel.
  bool in_margin(Index x, Index y, Index z) const {
    const Index bit = x + 1;
    return (word(bit >> 6, y, z) >> (bit & 63) & 1) != 0;
  }

  /// Precondition: grid().contains(x, y, z). Threads may write different z at the same time.
  void set(Index x, Index y, Index z, bool inside = true) {
    const Index bit = x + 1;
    const Word mask = Word{1} << (bit & 63);
    Word& w = words_[index(bit >> 6, y, z)];
    w = inside ? (w | mask) : (w & ~mask);
  }

  /// The number of voxels in the set.
  Index count() const;

  /// Words that hold a row along x with its margin: bit b of word w is x = 64 w + b - 1.
  Index words_per_row() const { return words_per_row_; }
  /// Words between a row and the row of the next word (y + 2 margins).
  Index word_stride() const { return word_stride_; }
  /// Words between a row and the row of the next z.
  Index slice_stride() const { return slice_stride_; }

  /// Word w of row (y, z); w in [0, words_per_row()), y in [-1, size y], z in [-1, size z].
  Word word(Index w, Index y, Index z) const { return words_[index(w, y, z)]; }
  /// Its address: consecutive y follow at +1. Up to kSlack words may be read beyond either end of
  /// the volume's memory (they are 0 there).
  const Word* word_address(Index w, Index y, Index z) const {
    return words_.data() + index(w, y, z);
  }
  /// Replaces word w of row (y, z). Precondition: the bits of the margin are 0.
  void set_word(Index w, Index y, Index z, Word value) { words_[index(w, y, z)] = value; }

  /// What a volume of this grid takes. \throws as the constructor.
  static Index bytes_for(const Grid& grid);
  /// The bytes of all words, margins and slack included.
  std::size_t memory_bytes() const { return words_.size() * sizeof(Word); }

  /// Words of 0 before and after those of the volume; see word_address().
  static constexpr Index kSlack = 8;

 private:
  std::size_t index(Index w, Index y, Index z) const {
    return static_cast<std::size_t>(kSlack + (z + 1) * slice_stride_ + w * word_stride_ + y + 1);
  }

  Grid grid_;
  Index words_per_row_ = 0;
  Index word_stride_ = 0;
  Index slice_stride_ = 0;
  std::vector<Word> words_;
};

}  // namespace dsc
