/// \file
/// \internal
/// The cells of a binary volume's boundary, as bits, straight from the volume's own words.
///
/// Every cell belongs to the bit of its low corner: the surfel across `axis` that has voxel q on
/// its upper side belongs to q, and so does the pointel at q's low corner.
#pragma once

#include "libdsc/surface/topology.h"
#include "libdsc/voxels/binary_volume.h"
#include "libdsc/voxels/label_volume.h"

namespace dsc {

class BinaryCells {
 public:
  using Word = BinaryVolume::Word;

  explicit BinaryCells(const BinaryVolume& volume) : volume_(volume) {}

  const Grid& grid() const { return volume_.grid(); }
  Index words() const { return volume_.words_per_row(); }

  /// 1 inside, 0 outside; for voxels of the grid or of its margin of one.
  Label label(Index x, Index y, Index z) const { return volume_.in_margin(x, y, z) ? 1 : 0; }

  /// The labels on the lower and upper side of the surfel across `axis` with voxel (x, y, z) above.
  LabelPair labels_across(int, Index x, Index y, Index z) const {
    const Label upper = label(x, y, z);
    return {1 - upper, upper};
  }
  /// The labels of the four voxels around a linel: `inner` and the voxel outside it, and the steps
  /// of both in another direction, where there are surfels beside the inner voxel and beside the
  /// outer one or not. With two labels that tells all.
  static std::array<Label, 4> around(const topology::Voxel&, int, int, bool beside_inner,
                                     bool beside_outer) {
    return {1, 0, beside_inner ? Label{0} : Label{1}, beside_outer ? Label{1} : Label{0}};
  }

  /// What a block of words has in common.
  struct Overview {
    Word some = 0;        ///< bits that are in some row
    Word all = ~Word{0};  ///< bits that are in every row

    /// False where all voxels that touch the block's cells are alike; `before` is the overview of
    /// the words w - 1.
    bool may_have_cells(const Overview& before) const {
      const Word first = Word{1} << 63;
      return (some | (before.some & first)) != 0 && (~all | (~before.all & first)) != 0;
    }
  };
  /// Of words w of the rows that touch the cells of rows [first, last) of slice z.
  Overview overview(Index w, Index first, Index last, Index z) const {
    const Word* here = volume_.word_address(w, first - 1, z);
    const Word* below = volume_.word_address(w, first - 1, z - 1);
    Overview result;
    for (Index i = 0; i <= last - first; ++i) {
      result.some |= here[i] | below[i];
      result.all &= here[i] & below[i];
    }
    return result;
  }

  /// Bits of the surfels across `axis` that belong to word w of row (y, z).
  Word surfel_bits(int axis, Index w, Index y, Index z) const {
    const Word here = volume_.word(w, y, z);
    switch (axis) {
      case 0:
        return here ^ (here << 1 | (w > 0 ? volume_.word(w - 1, y, z) >> 63 : 0));
      case 1:
        return here ^ volume_.word(w, y - 1, z);
      default:
        return here ^ volume_.word(w, y, z - 1);
    }
  }
  /// Bits of the pointels: where the eight voxels around are not all alike.
  Word pointel_bits(Index w, Index y, Index z) const {
    const Four here = rows(w, y, z);
    const Four before = w > 0 ? rows(w - 1, y, z) : Four{0, 0};
    const Word some = here.some | here.some << 1 | before.some >> 63;
    const Word all = here.all & (here.all << 1 | before.all >> 63);
    return some & ~all;
  }

 private:
  struct Four {
    Word some, all;
  };
  /// Union and intersection of the four rows at (y - 1 … y, z - 1 … z).
  Four rows(Index w, Index y, Index z) const {
    const Word a = volume_.word(w, y, z), b = volume_.word(w, y - 1, z);
    const Word c = volume_.word(w, y, z - 1), d = volume_.word(w, y - 1, z - 1);
    return {a | b | c | d, a & b & c & d};
  }

  const BinaryVolume& volume_;
};

}  // namespace dsc
