/// \file
/// \internal
/// Numbers for the surfels and pointels of a volume, found by counting bits.
///
/// Every cell (surfel, pointel) belongs to the bit of its low corner (binary_cells.h). The cells of
/// one word of 64 voxels are numbered one after another, so the number of a cell is the count
/// before its word plus a population count: no hash. Only words that have cells are kept, 48 bytes
/// each, so a volume that is mostly empty costs its scan and nothing else.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/base/types.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace dsc {

/// The cells of one word of a row.
struct CellWord {
  std::array<std::uint64_t, 3> surfels{};  ///< bits of the surfels across each axis
  std::uint64_t pointels = 0;
  std::uint32_t first_face = 0;  ///< faces and vertices before this word, within its slice
  std::uint32_t first_vertex = 0;
  std::int32_t y = 0;
  std::array<std::uint8_t, 3> before{};  ///< faces of this word across the axes before each

  bool touches_neighbour() const {
    constexpr std::uint64_t kEnds = 1 | std::uint64_t{1} << 63;
    return ((surfels[0] | surfels[1] | surfels[2]) & kEnds) != 0;
  }
};

class SurfelNumbering {
 public:
  /// Counts all cells, in parallel over z. `Cells` is BinaryCells or LabelCells.
  /// \throws LimitError where ids pass 32 bits.
  template <class Cells>
  SurfelNumbering(const Cells& cells, const Context& context);

  Index faces() const { return face_base_.back(); }
  Index vertices() const { return vertex_base_.back(); }

  /// The order of the numbering: slices z in [0, slices()), in them words w of the rows in
  /// [0, words()), in these y, in a word the surfels across x, y, z, each by x.
  Index slices() const { return static_cast<Index>(slices_.size()); }
  Index words() const { return words_; }

  /// The words w of slice z that have cells, by y; none outside the volume.
  std::span<const CellWord> column(Index w, Index z) const {
    if (w < 0 || w >= words_ || z < 0 || z >= slices()) return {};
    const std::uint32_t* begin = begins_.data() + z * (words_ + 1) + w;
    return std::span(slices_[static_cast<std::size_t>(z)]).subspan(begin[0], begin[1] - begin[0]);
  }
  /// Faces and vertices before slice z, z in [0, slices()].
  Index face_base(Index z) const { return face_base_[static_cast<std::size_t>(z)]; }
  Index vertex_base(Index z) const { return vertex_base_[static_cast<std::size_t>(z)]; }

 private:
  Index words_;
  std::vector<std::vector<CellWord>> slices_;
  std::vector<std::uint32_t> begins_;           ///< of the columns, words + 1 a slice
  std::vector<Index> face_base_, vertex_base_;  ///< cells before each slice, and in all
};

}  // namespace dsc
