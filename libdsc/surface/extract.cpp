#include "libdsc/surface/extract.h"

#include "libdsc/base/parallel.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/surface_builder.h"
#include "libdsc/surface/surfel_numbering.h"
#include "libdsc/surface/topology.h"

#include <limits>

namespace dsc {
namespace {

using topology::kSideFacing;
using topology::kStep;
using topology::SideCode;

/// Fills a builder with the boundary of a voxel set, word after word.
class Extraction {
 public:
  Extraction(const BinaryVolume& volume, Adjacency adjacency, const Context& context)
      : volume_(volume),
        adjacency_(adjacency),
        numbering_(volume, context),
        builder_(volume.grid(), numbering_.vertices(), numbering_.faces()),
        surfels_(builder_.surfels()),
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

  bool inside(const Voxel& v) const { return volume_.in_margin(v.x, v.y, v.z); }

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
    for (auto bits = numbering_.pointel_bits(w, y, z); bits != 0; bits &= bits - 1) {
      const double x = static_cast<double>(64 * w + std::countr_zero(bits) - 1);
      const Vec3 p = volume_.grid().position(x - 0.5, static_cast<double>(y) - 0.5,
                                             static_cast<double>(z) - 0.5);
      positions_[static_cast<std::size_t>(vertex++)] = {p[0], p[1], p[2]};
    }
    Index face = numbering_.first_face(w, y, z);
    for (int axis = 0; axis < 3; ++axis) {
      for (auto bits = numbering_.surfel_bits(axis, w, y, z); bits != 0; bits &= bits - 1) {
        const Voxel upper{64 * w + std::countr_zero(bits) - 1, y, z};
        const int direction = inside(upper) ? 2 * axis : 2 * axis + 1;
        const Voxel inner =
            inside(upper) ? upper : upper.step(topology::opposite_direction(direction));
        surfel(face++, {inner, direction}, junctions);
      }
    }
  }

  void surfel(Index face, const Cell& s, std::vector<topology::Junction>& junctions) {
    const auto f = static_cast<std::size_t>(face);
    surfels_[f] = {static_cast<std::int32_t>(s.inner.x), static_cast<std::int32_t>(s.inner.y),
                   static_cast<std::int32_t>(s.inner.z), s.direction};
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

  /// The side that this one, of surfel s, facing e, is linked to. Around their linel lie four
  /// voxels: s's inner and outer one, and the steps of both along e.
  SideCode link(SideCode self, const Cell& s, int e, std::vector<topology::Junction>& junctions) {
    const int d = s.direction, back = topology::opposite_direction(e);
    const Voxel inner_e = s.inner.step(e), outer_e = inner_e.step(d);
    const bool outer_in = inside(outer_e), inner_in = inside(inner_e);
    if (inner_in && !outer_in) return side({inner_e, d}, back);
    if (inner_in) return side({outer_e, back}, topology::opposite_direction(d));
    if (!outer_in) return side({s.inner, e}, d);
    const SideCode same_inner = side({s.inner, e}, d);
    const SideCode same_outer = side({outer_e, back}, topology::opposite_direction(d));
    const SideCode across = side({outer_e, topology::opposite_direction(d)}, back);
    if (self < same_inner && self < same_outer && self < across) {
      junctions.push_back({{self, same_inner, across, same_outer}});
    }
    return adjacency_ == Adjacency::interior ? same_inner : same_outer;
  }

  const BinaryVolume& volume_;
  Adjacency adjacency_;
  SurfelNumbering numbering_;
  SurfaceBuilder builder_;
  std::span<Surfel> surfels_;
  std::span<QuadCorners> corners_;
  std::span<OpenMesh::Vec3d> positions_;
  std::vector<SideCode>& opposite_;
};

/// Which faces the options keep; empty where all are kept.
std::vector<std::uint8_t> kept_faces(std::span<const Surfel> surfels, const Grid& grid,
                                     const ExtractOptions& options, const Context& context) {
  if (options.border == Border::closed && !options.part) return {};
  std::vector<std::uint8_t> keep(surfels.size());
  parallel_for(context, static_cast<Index>(surfels.size()), 4096, [&](Index first, Index last) {
    for (auto f = static_cast<std::size_t>(first); f < static_cast<std::size_t>(last); ++f) {
      const Surfel& s = surfels[f];
      const auto& step = kStep[s.direction];
      const bool open = options.border == Border::open &&
                        !grid.contains(s.x + step[0], s.y + step[1], s.z + step[2]);
      keep[f] = !open && (!options.part || options.part(s)) ? 1 : 0;
    }
  });
  return keep;
}

}  // namespace

DigitalSurface extract_surface(const BinaryVolume& volume, const ExtractOptions& options,
                               const Context& context) {
  for (const Index n : volume.grid().size) {
    if (n >= std::numeric_limits<std::int32_t>::max()) {
      throw LimitError("surface: a volume of " + std::to_string(n) +
                       " voxels along one axis is beyond 32-bit surfel coordinates");
    }
  }
  SurfaceBuilder builder = Extraction(volume, options.adjacency, context).run(context);
  const auto keep = kept_faces(builder.surfels(), volume.grid(), options, context);
  if (!keep.empty()) builder = std::move(builder).part(keep, context);
  return std::move(builder).finish(options.adjacency, options.glue, context);
}

}  // namespace dsc
