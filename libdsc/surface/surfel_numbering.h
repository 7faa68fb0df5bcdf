/// \file
/// Numbers for the surfels and pointels of a volume, found by counting bits.
///
/// Every cell (surfel, pointel) belongs to the bit of its low corner (binary_cells.h). The cells of
/// one word of 64 voxels are numbered one after another, so the number of a cell is the count
/// before its word plus a population count: no hash and no search.
#pragma once

#include "libdsc/base/context.h"

#include <bit>
#include <cstdint>
#include <vector>

namespace dsc {

/// `Cells` is BinaryCells or LabelCells.
template <class Cells>
class SurfelNumbering {
 public:
  using Word = typename Cells::Word;

  /// Counts all cells, in parallel over z. `cells` must outlive this.
  /// \throws LimitError where ids pass 32 bits.
  SurfelNumbering(const Cells& cells, const Context& context);

  Index faces() const { return face_base_.back(); }
  Index vertices() const { return vertex_base_.back(); }

  /// Slices of words, z in [0, slices()); within one, slots w, y in the order of the numbering.
  Index slices() const { return static_cast<Index>(face_base_.size()) - 1; }
  Index words() const { return words_; }
  Index rows() const { return rows_; }

  /// Whether word w of row (y, z) has any cell.
  bool has_cells(Index w, Index y, Index z) const {
    const std::size_t slot = slot_of(w, y, z);
    const std::size_t next = slot + 1;
    return next == slots_.size() || (next % slice_) == 0 ||
           slots_[slot].vertices != slots_[next].vertices;
  }
  Index first_face(Index w, Index y, Index z) const {
    return face_base_[static_cast<std::size_t>(z)] + slots_[slot_of(w, y, z)].faces;
  }
  Index first_vertex(Index w, Index y, Index z) const {
    return vertex_base_[static_cast<std::size_t>(z)] + slots_[slot_of(w, y, z)].vertices;
  }

  /// The number of the surfel between voxel q = (x, y, z) and its lower neighbour along `axis`.
  /// Precondition: that surfel exists.
  Index face_id(int axis, Index x, Index y, Index z) const {
    const Index bit = x + 1, w = bit >> 6;
    Index id = first_face(w, y, z);
    for (int a = 0; a < axis; ++a) id += std::popcount(cells_.surfel_bits(a, w, y, z));
    return id + std::popcount(cells_.surfel_bits(axis, w, y, z) & below(bit));
  }
  /// The number of the pointel (x, y, z). Precondition: it exists.
  Index vertex_id(Index x, Index y, Index z) const {
    const Index bit = x + 1, w = bit >> 6;
    return first_vertex(w, y, z) + std::popcount(cells_.pointel_bits(w, y, z) & below(bit));
  }

 private:
  struct Counts {
    std::uint32_t faces, vertices;
  };
  static Word below(Index bit) { return (Word{1} << (bit & 63)) - 1; }
  std::size_t slot_of(Index w, Index y, Index z) const {
    return static_cast<std::size_t>(z) * slice_ + static_cast<std::size_t>(w * rows_ + y);
  }

  const Cells& cells_;
  Index words_, rows_;
  std::size_t slice_;                           ///< slots a slice
  std::vector<Counts> slots_;                   ///< cells before this slot, within its slice
  std::vector<Index> face_base_, vertex_base_;  ///< cells before each slice, and in all
};

}  // namespace dsc
