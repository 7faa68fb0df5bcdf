/// \file
/// \internal
/// The cells around a word of 64 voxels: the 27 words that its surfels can touch.
///
/// Positions are given from voxel (64 w + bit - 1, y, z) of the word at hand: a place is the word's
/// row, dy and dz in {-1, 0, 1}, and a bit in [-1, 64]; bits beyond the word are of its neighbours
/// along x.
#pragma once

#include "libdsc/base/bits.h"
#include "libdsc/surface/surfel_numbering.h"

#include <array>

namespace dsc {

class CellNeighbourhood {
 public:
  /// Around the words w of slice z.
  CellNeighbourhood(const SurfelNumbering& numbering, Index w, Index z) {
    for (Index dz = -1; dz <= 1; ++dz) {
      for (Index dw = -1; dw <= 1; ++dw) {
        columns_[static_cast<std::size_t>(3 * (dw + 1) + dz + 1)].words =
            numbering.column(w + dw, z + dz);
      }
      if (z + dz < 0 || z + dz >= numbering.slices()) continue;
      face_base_[static_cast<std::size_t>(dz + 1)] = numbering.face_base(z + dz);
      vertex_base_[static_cast<std::size_t>(dz + 1)] = numbering.vertex_base(z + dz);
    }
  }

  /// Moves to a word of the column; y must ascend from call to call.
  void move_to(const CellWord& word) {
    for (std::size_t dz = 0; dz < 3; ++dz) look(1, dz, word.y);
    if (!word.touches_neighbour()) return;  // bits beyond the word will not be asked for
    for (std::size_t dz = 0; dz < 3; ++dz) {
      look(0, dz, word.y);
      look(2, dz, word.y);
    }
  }

  /// row(dy, dz) names a row.
  static constexpr int row(int dy, int dz) { return 3 * (dz + 1) + dy + 1; }

  bool has_surfel(int axis, int bit, int row) const {
    return (at(bit, row).surfels[static_cast<std::size_t>(axis)] >> (bit & 63) & 1) != 0;
  }
  /// Precondition: the surfel exists.
  Index face_id(int axis, int bit, int row) const {
    const CellWord& word = at(bit, row);
    const auto a = static_cast<std::size_t>(axis);
    return face_base_[static_cast<std::size_t>(row) / 3] + word.first_face + word.before[a] +
           count_bits(word.surfels[a] & below(bit));
  }
  /// Precondition: the pointel exists.
  Index vertex_id(int bit, int row) const {
    const CellWord& word = at(bit, row);
    return vertex_base_[static_cast<std::size_t>(row) / 3] + word.first_vertex +
           count_bits(word.pointels & below(bit));
  }

 private:
  struct Column {
    std::span<const CellWord> words;
    std::size_t next = 0;
  };

  static constexpr std::uint64_t below(int bit) { return (std::uint64_t{1} << (bit & 63)) - 1; }

  const CellWord& at(int bit, int row) const {
    return *near_[static_cast<std::size_t>(9 * ((bit >> 6) + 1) + row)];
  }
  /// Finds the words of a column at rows y - 1 … y + 1.
  void look(std::size_t dw, std::size_t dz, std::int32_t y) {
    static constexpr CellWord kNone;
    Column& column = columns_[3 * dw + dz];
    while (column.next < column.words.size() && column.words[column.next].y < y - 1) ++column.next;
    std::size_t k = column.next;
    for (std::int32_t dy = 0; dy < 3; ++dy) {
      const bool here = k < column.words.size() && column.words[k].y == y - 1 + dy;
      near_[9 * dw + 3 * dz + static_cast<std::size_t>(dy)] = here ? &column.words[k++] : &kNone;
    }
  }

  std::array<Column, 9> columns_;                     ///< at 3 dw + dz, each + 1
  std::array<const CellWord*, 27> near_{};            ///< at 9 dw + row
  std::array<Index, 3> face_base_{}, vertex_base_{};  ///< of slices z - 1 … z + 1
};

}  // namespace dsc
