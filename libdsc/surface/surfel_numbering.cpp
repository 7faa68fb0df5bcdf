#include "libdsc/surface/surfel_numbering.h"

#include "libdsc/base/checked.h"
#include "libdsc/base/parallel.h"
#include "libdsc/surface/binary_cells.h"
#include "libdsc/surface/label_cells.h"

#include <limits>
#include <new>

namespace dsc {

template <class Cells>
SurfelNumbering<Cells>::SurfelNumbering(const Cells& cells, const Context& context)
    : cells_(cells) {
  const Index3 size = cells.grid().size;
  words_ = cells.words();
  rows_ = size[1] + 1;
  const Index slices = size[2] + 1;
  slice_ = static_cast<std::size_t>(words_ * rows_);
  face_base_.assign(static_cast<std::size_t>(slices + 1), 0);
  vertex_base_.assign(static_cast<std::size_t>(slices + 1), 0);
  slots_.resize(slice_ * static_cast<std::size_t>(slices));

  // 8 bytes read and 8 written a word: the scan runs at the speed of memory where words are
  // uniform.
  context.begin("scan", slices);
  parallel_for(context, slices, 1, [&](Index z, Index) {
    Index faces = 0, vertices = 0;
    Counts* slot = slots_.data() + static_cast<std::size_t>(z) * slice_;
    for (Index w = 0; w < words_; ++w) {
      for (Index y = 0; y < rows_; ++y, ++slot) {
        *slot = {static_cast<std::uint32_t>(faces), static_cast<std::uint32_t>(vertices)};
        const Word pointels = cells_.pointel_bits(w, y, z);
        if (pointels == 0) continue;
        vertices += std::popcount(pointels);
        for (int axis = 0; axis < 3; ++axis)
          faces += std::popcount(cells_.surfel_bits(axis, w, y, z));
      }
    }
    if (faces > std::numeric_limits<VertexId>::max()) {
      throw LimitError(
          "surface: one slice of the volume has more faces than 32-bit ids can number");
    }
    face_base_[static_cast<std::size_t>(z) + 1] = faces;
    vertex_base_[static_cast<std::size_t>(z) + 1] = vertices;
    context.advance(1);
  });
  for (std::size_t z = 1; z < face_base_.size(); ++z) {
    face_base_[z] += face_base_[z - 1];
    vertex_base_[z] += vertex_base_[z - 1];
  }
  // Four sides a face, two halfedges a side, all numbered by int.
  (void)checked_id(checked_product(8, face_base_.back(), "surface halfedges"), "surface halfedges");
}

template class SurfelNumbering<BinaryCells>;
template class SurfelNumbering<LabelCells>;

}  // namespace dsc
