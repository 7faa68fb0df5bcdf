#include "libdsc/surface/surfel_numbering.h"

#include "libdsc/base/bits.h"
#include "libdsc/base/checked.h"
#include "libdsc/base/parallel.h"
#include "libdsc/surface/binary_cells.h"
#include "libdsc/surface/label_cells.h"

#include <limits>

namespace dsc {
namespace {

/// Rows that are looked at together; where they are all alike, not one by one.
constexpr Index kBlock = 32;

/// The cells of one slice, word after word.
template <class Cells>
class SliceScan {
 public:
  SliceScan(const Cells& cells, std::vector<CellWord>& out)
      : cells_(cells), rows_(cells.grid().size[1] + 1), out_(out) {}

  Index faces() const { return faces_; }
  Index vertices() const { return vertices_; }

  /// Appends words w of slice z. To be called for ascending w.
  void column(Index w, Index z) {
    blocks_.resize(static_cast<std::size_t>((rows_ + kBlock - 1) / kBlock));
    for (Index first = 0; first < rows_; first += kBlock) {
      const Index last = std::min(rows_, first + kBlock);
      const auto here = cells_.overview(w, first, last, z);
      auto& before = blocks_[static_cast<std::size_t>(first / kBlock)];
      if (here.may_have_cells(before)) {
        for (Index y = first; y < last; ++y) word(w, y, z);
      }
      before = here;
    }
  }

 private:
  void word(Index w, Index y, Index z) {
    CellWord cell;
    cell.pointels = cells_.pointel_bits(w, y, z);
    if (cell.pointels == 0) return;
    cell.y = static_cast<std::int32_t>(y);
    cell.first_face = static_cast<std::uint32_t>(faces_);
    cell.first_vertex = static_cast<std::uint32_t>(vertices_);
    int faces = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      cell.surfels[a] = cells_.surfel_bits(axis, w, y, z);
      cell.before[a] = static_cast<std::uint8_t>(faces);
      faces += count_bits(cell.surfels[a]);
    }
    faces_ += faces;
    vertices_ += count_bits(cell.pointels);
    out_.push_back(cell);
  }

  const Cells& cells_;
  Index rows_;
  std::vector<CellWord>& out_;
  std::vector<typename Cells::Overview> blocks_;  ///< of the words w - 1
  Index faces_ = 0, vertices_ = 0;
};

}  // namespace

template <class Cells>
SurfelNumbering::SurfelNumbering(const Cells& cells, const Context& context)
    : words_(cells.words()) {
  const auto slices = static_cast<std::size_t>(cells.grid().size[2] + 1);
  context.need("scan",
               static_cast<Index>(slices) *
                   static_cast<Index>(sizeof slices_[0] + 16 +
                                      sizeof begins_[0] * static_cast<std::size_t>(words_ + 1)));
  slices_.resize(slices);
  begins_.assign(slices * static_cast<std::size_t>(words_ + 1), 0);
  face_base_.assign(slices + 1, 0);
  vertex_base_.assign(slices + 1, 0);

  // Every word is read from memory once, and from the cache again for the next slice.
  context.begin("scan", static_cast<Index>(slices));
  parallel_for(context, static_cast<Index>(slices), 1, [&](Index z, Index) {
    const auto slice = static_cast<std::size_t>(z);
    SliceScan<Cells> scan(cells, slices_[slice]);
    std::uint32_t* end = begins_.data() + z * (words_ + 1);
    for (Index w = 0; w < words_; ++w) {
      scan.column(w, z);
      *++end = static_cast<std::uint32_t>(slices_[slice].size());
    }
    if (scan.faces() > std::numeric_limits<VertexId>::max()) {
      throw LimitError(
          "surface: one slice of the volume has more faces than 32-bit ids can number");
    }
    // How many words have cells is not known before; the next slice takes about as much as this.
    context.need("scan", static_cast<Index>(slices_[slice].capacity() * sizeof(CellWord)));
    face_base_[slice + 1] = scan.faces();
    vertex_base_[slice + 1] = scan.vertices();
    context.advance(1);
  });
  for (std::size_t z = 1; z < face_base_.size(); ++z) {
    face_base_[z] += face_base_[z - 1];
    vertex_base_[z] += vertex_base_[z - 1];
  }
  // Four sides a face, two halfedges a side, all numbered by int.
  (void)checked_id(checked_product(8, face_base_.back(), "surface halfedges"), "surface halfedges");
}

template SurfelNumbering::SurfelNumbering(const BinaryCells&, const Context&);
template SurfelNumbering::SurfelNumbering(const LabelCells&, const Context&);

}  // namespace dsc
