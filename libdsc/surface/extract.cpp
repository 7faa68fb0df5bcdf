#include "libdsc/surface/extract.h"

#include "libdsc/base/parallel.h"
#include "libdsc/surface/binary_cells.h"
#include "libdsc/surface/cell_neighbourhood.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/label_cells.h"
#include "libdsc/surface/surface_builder.h"
#include "libdsc/surface/surfel_numbering.h"
#include "libdsc/surface/surfel_places.h"
#include "libdsc/surface/topology.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace dsc {
namespace {

using topology::Junction;
using topology::kNoSide;
using topology::kPlaces;
using topology::kSideDirection;
using topology::kSideFacing;
using topology::kStep;
using topology::Place;
using topology::Places;
using topology::SideCode;
using topology::Voxel;

constexpr int kOwnRow = CellNeighbourhood::row(0, 0);

/// Fills a builder with all surfels of a volume, word after word.
template <class Cells>
class Extraction {
 public:
  /// `whole`: no part of the surface will be taken; `with_labels`: the faces get the property of
  /// their two labels.
  Extraction(const Cells& cells, Adjacency adjacency, bool whole, bool with_labels,
             const Context& context)
      : cells_(cells),
        adjacency_(adjacency),
        numbering_(cells, context),
        builder_(cells.grid(), numbering_.vertices(), numbering_.faces(), with_labels, whole,
                 context),
        surfels_(builder_.surfels()),
        labels_(builder_.labels()),
        corners_(builder_.corners()),
        positions_(builder_.positions()),
        opposite_(builder_.opposite()) {}

  SurfaceBuilder run(const Context& context) && {
    std::vector<std::vector<Junction>> junctions(static_cast<std::size_t>(numbering_.slices()));
    context.begin("extract", numbering_.slices());
    parallel_for(context, numbering_.slices() + 1, 1, [&](Index task, Index) {
      if (task == 0) {
        builder_.make_edges();
        return;
      }
      const Index z = task - 1;
      for (Index w = 0; w < numbering_.words(); ++w) {
        CellNeighbourhood near(numbering_, w, z);
        for (const CellWord& here : numbering_.column(w, z)) {
          near.move_to(here);
          word(here, w, z, near, junctions[static_cast<std::size_t>(z)]);
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
  /// All cells of a word.
  void word(const CellWord& here, Index w, Index z, const CellNeighbourhood& near,
            std::vector<Junction>& junctions) {
    const Index first_x = 64 * w - 1;
    auto vertex = static_cast<std::size_t>(numbering_.vertex_base(z) + here.first_vertex);
    for (auto bits = here.pointels; bits != 0; bits &= bits - 1) {
      const auto x = static_cast<double>(first_x + std::countr_zero(bits));
      const Vec3 p = cells_.grid().position(x - 0.5, static_cast<double>(here.y) - 0.5,
                                            static_cast<double>(z) - 0.5);
      positions_[vertex++] = {p[0], p[1], p[2]};
    }
    Index face = numbering_.face_base(z) + here.first_face;
    for (int axis = 0; axis < 3; ++axis) {
      for (auto bits = here.surfels[static_cast<std::size_t>(axis)]; bits != 0; bits &= bits - 1) {
        const int bit = std::countr_zero(bits);
        surfel(face++, axis, bit, {first_x + bit, here.y, z}, near, junctions);
      }
    }
  }

  /// The surfel across `axis` that has voxel `upper` above.
  void surfel(Index face, int axis, int bit, const Voxel& upper, const CellNeighbourhood& near,
              std::vector<Junction>& junctions) {
    const auto f = static_cast<std::size_t>(face);
    const auto [low, high] = cells_.labels_across(axis, upper.x, upper.y, upper.z);
    const bool up = is_inner(low, high);  // the normal points along +axis
    const int d = 2 * axis + (up ? 1 : 0);
    const Voxel inner = up ? upper.step(2 * axis) : upper;
    surfels_[f] = {static_cast<std::int32_t>(inner.x), static_cast<std::int32_t>(inner.y),
                   static_cast<std::int32_t>(inner.z), d};
    if (!labels_.empty()) labels_[f] = up ? LabelPair{low, high} : LabelPair{high, low};
    const Places& places = kPlaces[static_cast<std::size_t>(d)];
    for (std::size_t i = 0; i < 4; ++i) {
      const Place& corner = places.corners[i];
      if (corner.dx == 0) corners_[f][i] = static_cast<VertexId>(near.vertex_id(bit, corner.row));
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const Place& corner = places.corners[i];
      if (corner.dx == 0) continue;
      corners_[f][i] = bit < 63  // the next pointel of the same word
                           ? corners_[f][places.before[i]] + 1
                           : static_cast<VertexId>(near.vertex_id(bit + 1, corner.row));
    }
    for (int i = 0; i < 4; ++i) {
      opposite_[4 * f + static_cast<std::size_t>(i)] =
          link(topology::side_code(face, i), inner, d, bit, near, junctions);
    }
  }

  /// The side that this one, of the surfel of direction d of voxel `inner`, is linked to: that of
  /// the surfel which separates the same two labels, and where all four at the linel do, the one
  /// that the adjacency names. The side faces direction e. Around the linel lie the inner and outer
  /// voxel and the steps of both along e, and between them the surfels: the one at hand, b beside
  /// the inner voxel, c across, d beside the outer voxel.
  SideCode link(SideCode self, const Voxel& inner, int d, int bit, const CellNeighbourhood& near,
                std::vector<Junction>& junctions) const {
    // Names of their own: clang 14 does not let lambdas see structured bindings.
    const auto& beside =
        kPlaces[static_cast<std::size_t>(d)].beside[static_cast<std::size_t>(self & 3)];
    const Place &b = beside[0], &c = beside[1], &dd = beside[2];
    const auto has = [&](const Place& p) { return near.has_surfel(p.axis, bit + p.dx, p.row); };
    const auto side = [&](const Place& p, int direction, int facing) {
      return topology::side_code(near.face_id(p.axis, bit + p.dx, p.row),
                                 kSideFacing[direction][facing]);
    };
    const int e = kSideDirection[d][self & 3];
    const int back = topology::opposite_direction(e), down = topology::opposite_direction(d);
    const bool has_b = has(b), has_d = has(dd);
    if (!has_b && !has_d) {
      // Across a side that faces ±x lies the face before or after, unless it is of another word.
      const bool same_word = c.row == kOwnRow && bit + c.dx >= 0 && bit + c.dx < 64;
      const int facing = kSideFacing[d][back];
      return same_word ? topology::side_code(topology::face_of(self) + c.dx, facing)
                       : topology::side_code(near.face_id(c.axis, bit + c.dx, c.row), facing);
    }

    const std::array<Label, 4> labels = cells_.around(inner, d, e, has_b, has_d);
    const Label in = labels[0], out = labels[1], in_e = labels[2], out_e = labels[3];
    const bool has_c = in_e != out_e;
    const auto side_b = [&] { return side(b, is_inner(in, in_e) ? e : back, d); };
    const auto side_c = [&] { return side(c, is_inner(in_e, out_e) ? d : down, back); };
    const auto side_d = [&] { return side(dd, is_inner(out, out_e) ? e : back, down); };
    if (has_b + has_c + has_d > 1) {
      const Junction junction{{self, has_b ? side_b() : kNoSide, has_c ? side_c() : kNoSide,
                               has_d ? side_d() : kNoSide}};
      if (std::all_of(junction.sides.begin() + 1, junction.sides.end(),
                      [&](SideCode other) { return other == kNoSide || self < other; })) {
        junctions.push_back(junction);
      }
    }
    const bool to_b = in_e == out, to_d = out_e == in;
    if (to_b && to_d) return adjacency_ == Adjacency::interior ? side_b() : side_d();
    if (to_b) return side_b();
    return to_d ? side_d() : kNoSide;
  }

  const Cells& cells_;
  Adjacency adjacency_;
  SurfelNumbering numbering_;
  SurfaceBuilder builder_;
  std::span<Surfel> surfels_;
  std::span<LabelPair> labels_;
  std::span<QuadCorners> corners_;
  std::span<OpenMesh::Vec3d> positions_;
  std::span<SideCode> opposite_;
};

bool keeps_all(const ExtractOptions& options) {
  return options.border == Border::closed && !options.part && options.between.empty();
}

/// Which faces the options keep; empty where all are kept.
std::vector<std::uint8_t> kept_faces(SurfaceBuilder& builder, const Grid& grid,
                                     const ExtractOptions& options, const Context& context) {
  const auto surfels = builder.surfels();
  const auto labels = builder.labels();
  if (keeps_all(options)) return {};
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
      Extraction<Cells>(cells, options.adjacency, keeps_all(options), with_labels, context)
          .run(context);
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
