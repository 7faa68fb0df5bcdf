/// \file
/// \internal
/// The cells of all interfaces of a label volume, as bits: a surfel wherever two neighbours' labels
/// differ. Numbered as in binary_cells.h; 3 bits a voxel are kept.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/surface/topology.h"
#include "libdsc/voxels/label_volume.h"

namespace dsc {

class LabelCells {
 public:
  using Word = BinaryVolume::Word;

  LabelCells(const LabelVolume& volume, const Context& context);

  const Grid& grid() const { return volume_.grid(); }
  Index words() const { return words_; }
  Label label(Index x, Index y, Index z) const { return volume_(x, y, z); }

  /// As in BinaryCells.
  LabelPair labels_across(int axis, Index x, Index y, Index z) const {
    const topology::Voxel lower = topology::Voxel{x, y, z}.step(2 * axis);
    return {label(lower.x, lower.y, lower.z), label(x, y, z)};
  }
  std::array<Label, 4> around(const topology::Voxel& inner, int d, int e, bool beside_inner,
                              bool beside_outer) const {
    const topology::Voxel outer = inner.step(d), outer_e = outer.step(e), inner_e = inner.step(e);
    const Label in = label(inner.x, inner.y, inner.z), out = label(outer.x, outer.y, outer.z);
    return {in, out, beside_inner ? label(inner_e.x, inner_e.y, inner_e.z) : in,
            beside_outer ? label(outer_e.x, outer_e.y, outer_e.z) : out};
  }

  /// Comparing the labels has cost more than leaving out words could save.
  struct Overview {
    static bool may_have_cells(const Overview&) { return true; }
  };
  static Overview overview(Index, Index, Index, Index) { return {}; }

  Word surfel_bits(int axis, Index w, Index y, Index z) const {
    return bits_[static_cast<std::size_t>(axis)][at(w, y, z)];
  }
  /// A pointel is where any of the twelve surfels around it is.
  Word pointel_bits(Index w, Index y, Index z) const {
    return corners(w, y, z) | sides(w, y, z) << 1 | (w > 0 ? sides(w - 1, y, z) >> 63 : 0);
  }

 private:
  std::size_t at(Index w, Index y, Index z) const {
    return static_cast<std::size_t>(((z + 1) * words_ + w) * rows_ + y + 1);
  }
  /// Surfels across y and z that touch the low corner from the voxel column of the corner's own
  /// bit.
  Word sides(Index w, Index y, Index z) const {
    return bits_[1][at(w, y, z)] | bits_[1][at(w, y, z - 1)] | bits_[2][at(w, y, z)] |
           bits_[2][at(w, y - 1, z)];
  }
  Word corners(Index w, Index y, Index z) const {
    return sides(w, y, z) | bits_[0][at(w, y, z)] | bits_[0][at(w, y - 1, z)] |
           bits_[0][at(w, y, z - 1)] | bits_[0][at(w, y - 1, z - 1)];
  }

  const LabelVolume& volume_;
  Index words_, rows_;
  std::array<std::vector<Word>, 3> bits_;  ///< with a margin of one row below in y and z
};

}  // namespace dsc
