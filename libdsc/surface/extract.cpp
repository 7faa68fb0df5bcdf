#include "libdsc/surface/extract.h"

#include "libdsc/base/parallel.h"
#include "libdsc/surface/binary_cells.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/label_cells.h"
#include "libdsc/surface/surface_builder.h"
#include "libdsc/surface/surfel_numbering.h"
#include "libdsc/surface/topology.h"

#include <algorithm>
#include <limits>

namespace dsc {
namespace {

using topology::kNoSide;
using topology::kSideFacing;
using topology::kStep;
using topology::SideCode;

/// Fills a builder with all surfels of a volume, word after word.
template <class Cells>
class Extraction {
 public:
  /// `with_labels`: the faces get the property of their two labels.
  Extraction(const Cells& cells, Adjacency adjacency, bool with_labels, const Context& context)
      : cells_(cells),
        adjacency_(adjacency),
        numbering_(cells, context),
        builder_(cells.grid(), numbering_.vertices(), numbering_.faces(), with_labels),
        surfels_(builder_.surfels()),
        labels_(builder_.labels()),
        corners_(builder_.corners()),
        positions_(builder_.positions()),
        opposite_(builder_.opposite()) {}

  SurfaceBuilder run(const Context& context) && {
    std::vector<std::vector<topology::Junction>> junctions(
        static_cast<std::size_t>(numbering_.slices()));
    context.begin("extract", numbering_.slices());
    parallel_for(context, numbering_.slices(), 1, [&](Index z, Index) {
      for (Index w = 0; w < numbering_.words(); ++w) {
        for (Index y = 0; y < numbering_.rows(); ++y) {
          if (numbering_.has_cells(w, y, z)) word(w, y, z, junctions[static_cast<std::size_t>(z)]);
        }
      }
      context.advance(1);
    });
    for (const auto& slice : junctions) {
      builder_.junctions().insert(builder_.junctions().end(), slice.begin(), slice.end());
    }
    return std::move(builder_);
  }

 private:
  struct Voxel {
    Index x, y, z;
    Voxel step(int d) const { return {x + kStep[d][0], y + kStep[d][1], z + kStep[d][2]}; }
  };
  struct Cell {  ///< a surfel by inner voxel and direction
    Voxel inner;
    int direction;
  };

  Label label(const Voxel& v) const { return cells_.label(v.x, v.y, v.z); }

  /// The surfel between v and its neighbour in direction d, from its inner voxel outwards.
  Cell between(const Voxel& v, int d) const {
    const Voxel other = v.step(d);
    return is_inner(label(v), label(other)) ? Cell{v, d}
                                            : Cell{other, topology::opposite_direction(d)};
  }
  Index face_id(const Cell& s) const {
    const Voxel q = (s.direction & 1) != 0 ? s.inner.step(s.direction) : s.inner;
    return numbering_.face_id(s.direction >> 1, q.x, q.y, q.z);
  }
  SideCode side(const Cell& s, int facing) const {
    return topology::side_code(face_id(s), kSideFacing[s.direction][facing]);
  }

  /// All cells of word w of row (y, z).
  void word(Index w, Index y, Index z, std::vector<topology::Junction>& junctions) {
    Index vertex = numbering_.first_vertex(w, y, z);
    for (auto bits = cells_.pointel_bits(w, y, z); bits != 0; bits &= bits - 1) {
      const double x = static_cast<double>(64 * w + std::countr_zero(bits) - 1);
      const Vec3 p = cells_.grid().position(x - 0.5, static_cast<double>(y) - 0.5,
                                            static_cast<double>(z) - 0.5);
      positions_[static_cast<std::size_t>(vertex++)] = {p[0], p[1], p[2]};
    }
    Index face = numbering_.first_face(w, y, z);
    for (int axis = 0; axis < 3; ++axis) {
      for (auto bits = cells_.surfel_bits(axis, w, y, z); bits != 0; bits &= bits - 1) {
        const Voxel upper{64 * w + std::countr_zero(bits) - 1, y, z};
        surfel(face++, between(upper, 2 * axis), junctions);
      }
    }
  }

  void surfel(Index face, const Cell& s, std::vector<topology::Junction>& junctions) {
    const auto f = static_cast<std::size_t>(face);
    surfels_[f] = {static_cast<std::int32_t>(s.inner.x), static_cast<std::int32_t>(s.inner.y),
                   static_cast<std::int32_t>(s.inner.z), s.direction};
    if (!labels_.empty()) labels_[f] = {label(s.inner), label(s.inner.step(s.direction))};
    for (int i = 0; i < 4; ++i) {
      const auto& o = topology::kCornerOffset[s.direction][i];
      corners_[f][i] = static_cast<VertexId>(
          numbering_.vertex_id(s.inner.x + o[0], s.inner.y + o[1], s.inner.z + o[2]));
    }
    for (int i = 0; i < 4; ++i) {
      opposite_[4 * f + i] = link(topology::side_code(face, i), s,
                                  topology::kSideDirection[s.direction][i], junctions);
    }
  }

  /// The side that this one, of surfel s, facing e, is linked to: that of the surfel which
  /// separates the same two labels, and where all four at the linel do, the one that the adjacency
  /// names. Around the linel lie s's inner and outer voxel and the steps of both along e, and
  /// between them the surfels: s itself, b beside the inner voxel, c across, d beside the outer
  /// voxel.
  SideCode link(SideCode self, const Cell& s, int e, std::vector<topology::Junction>& junctions) {
    const int d = s.direction;
    const Voxel outer = s.inner.step(d), inner_e = s.inner.step(e), outer_e = outer.step(e);
    const Label in = label(s.inner), out = label(outer);
    const Label in_e = label(inner_e), out_e = label(outer_e);
    const auto side_b = [&] { return side(between(s.inner, e), d); };
    const auto side_c = [&] { return side(between(inner_e, d), topology::opposite_direction(e)); };
    const auto side_d = [&] { return side(between(outer, e), topology::opposite_direction(d)); };
    if (in_e == in && out_e == out) return side_c();
    const bool has_b = in != in_e, has_c = in_e != out_e, has_d = out != out_e;
    if (has_b + has_c + has_d > 1) {
      const SideCode b = has_b ? side_b() : kNoSide;
      const SideCode c = has_c ? side_c() : kNoSide;
      const SideCode dd = has_d ? side_d() : kNoSide;
      const auto after = [&](SideCode other) { return other == kNoSide || self < other; };
      if (after(b) && after(c) && after(dd)) junctions.push_back({{self, b, c, dd}});
    }
    const bool to_b = in_e == out, to_d = out_e == in;
    if (to_b && to_d) return adjacency_ == Adjacency::interior ? side_b() : side_d();
    if (to_b) return side_b();
    return to_d ? side_d() : kNoSide;
  }

  const Cells& cells_;
  Adjacency adjacency_;
  SurfelNumbering<Cells> numbering_;
  SurfaceBuilder builder_;
  std::span<Surfel> surfels_;
  std::span<LabelPair> labels_;
  std::span<QuadCorners> corners_;
  std::span<OpenMesh::Vec3d> positions_;
  std::vector<SideCode>& opposite_;
};

/// Which faces the options keep; empty where all are kept.
std::vector<std::uint8_t> kept_faces(SurfaceBuilder& builder, const Grid& grid,
                                     const ExtractOptions& options, const Context& context) {
  const auto surfels = builder.surfels();
  const auto labels = builder.labels();
  if (options.border == Border::closed && !options.part && options.between.empty()) return {};
  const auto wanted = [&](const LabelPair& pair) {
    return std::any_of(options.between.begin(), options.between.end(), [&](const LabelPair& p) {
      return p == pair || LabelPair{p[1], p[0]} == pair;
    });
  };
  std::vector<std::uint8_t> keep(surfels.size());
  parallel_for(context, static_cast<Index>(surfels.size()), 4096, [&](Index first, Index last) {
    for (auto f = static_cast<std::size_t>(first); f < static_cast<std::size_t>(last); ++f) {
      const Surfel& s = surfels[f];
      const auto& step = kStep[s.direction];
      if (options.border == Border::open &&
          !grid.contains(s.x + step[0], s.y + step[1], s.z + step[2])) {
        continue;
      }
      if (!options.between.empty() && !wanted(labels[f])) continue;
      keep[f] = !options.part || options.part(s) ? 1 : 0;
    }
  });
  return keep;
}

template <class Cells>
DigitalSurface extract(const Cells& cells, const ExtractOptions& options, bool with_labels,
                       const Context& context) {
  for (const Index n : cells.grid().size) {
    if (n >= std::numeric_limits<std::int32_t>::max()) {
      throw LimitError("surface: a volume of " + std::to_string(n) +
                       " voxels along one axis is beyond 32-bit surfel coordinates");
    }
  }
  SurfaceBuilder builder =
      Extraction<Cells>(cells, options.adjacency, with_labels, context).run(context);
  const auto keep = kept_faces(builder, cells.grid(), options, context);
  if (!keep.empty()) builder = std::move(builder).part(keep, context);
  return std::move(builder).finish(options.adjacency, options.glue, context);
}

}  // namespace

DigitalSurface extract_surface(const BinaryVolume& volume, const ExtractOptions& options,
                               const Context& context) {
  if (!options.between.empty()) {
    throw UsageError("surface: interfaces between labels need a label volume");
  }
  return extract(BinaryCells(volume), options, false, context);
}

DigitalSurface extract_surface(const LabelVolume& volume, const ExtractOptions& options,
                               const Context& context) {
  return extract(LabelCells(volume, context), options, true, context);
}

}  // namespace dsc
