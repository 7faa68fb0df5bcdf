/// \file
/// A label image: an unsigned number a voxel, 0 being the outside.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/voxels/binary_volume.h"
#include "libdsc/voxels/grid.h"

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

namespace dsc {

/// The number of a voxel; 0 is the outside.
using Label = std::uint32_t;

/// The two labels that a surfel separates: its inside's, its outside's. The smaller one is inside,
/// 0 always outside.
using LabelPair = std::array<Label, 2>;

/// Whether a voxel labelled `a` is on the inside of a surfel against one labelled `b`.
constexpr bool is_inner(Label a, Label b) { return a - 1 < b - 1; }  // 0 wraps to the largest

/// Labels of all voxels of a grid, in 1, 2 or 4 bytes each.
class LabelVolume {
 public:
  LabelVolume() = default;
  /// All voxels 0, stored in `bytes` (1, 2 or 4) each. \throws as BinaryVolume, UsageError on
  /// another width.
  LabelVolume(const Grid& grid, int bytes);

  /// Size, spacing and origin.
  const Grid& grid() const { return grid_; }
  /// The largest label that fits.
  Label largest() const;

  /// The label of voxel (x, y, z); 0 anywhere outside the grid.
  Label operator()(Index x, Index y, Index z) const {
    if (!grid_.contains(x, y, z)) return 0;
    const std::size_t i = index(x, y, z);
    switch (labels_.index()) {
      case 0:
        return (*std::get_if<0>(&labels_))[i];
      case 1:
        return (*std::get_if<1>(&labels_))[i];
      default:
        return (*std::get_if<2>(&labels_))[i];
    }
  }
  /// Preconditions: grid().contains(x, y, z), label <= largest().
  void set(Index x, Index y, Index z, Label label);
  /// Writes row (y, z) to out[0 … size x); zeros where it is outside the grid.
  void row(Index y, Index z, Label* out) const;

  /// The number of voxels with a label other than 0.
  Index count(const Context& context = {}) const;
  /// The labels that occur, 0 left out, ascending.
  std::vector<Label> labels(const Context& context = {}) const;
  /// The voxels that have one of the labels given.
  BinaryVolume select(std::span<const Label> labels, const Context& context = {}) const;

  /// What a volume of this grid with labels of `bytes` takes. \throws as the constructor.
  static Index bytes_for(const Grid& grid, int bytes);
  /// The bytes of all labels.
  std::size_t memory_bytes() const;

 private:
  std::size_t index(Index x, Index y, Index z) const {
    return static_cast<std::size_t>((z * grid_.size[1] + y) * grid_.size[0] + x);
  }

  Grid grid_;
  std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>, std::vector<std::uint32_t>>
      labels_;
};

}  // namespace dsc
