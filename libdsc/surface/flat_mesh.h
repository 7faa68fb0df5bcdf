/// \file
/// A polygon mesh as flat arrays: what the calculus reads, without OpenMesh in sight.
#pragma once

#include "libdsc/base/types.h"
#include "libdsc/surface/surfel.h"

#include <span>

namespace dsc {

/// A view of a polygon mesh; it owns nothing, so what it looks at must outlive it.
///
/// Corners are listed face after face, counter-clockwise seen from outside; corner c is vertex
/// corners[c]. Two faces share a degree of freedom exactly where they share a vertex id, whatever a
/// halfedge mesh had to split.
struct FlatMesh {
  Vec3View positions;                 ///< V, world units
  std::span<const VertexId> corners;  ///< C vertex ids, each in [0, V)
  std::span<const Index> offsets;     ///< F + 1 corner offsets; empty: every face is a quad
  Vec3View normals;                   ///< F estimated unit normals u; empty: naive

  /// Set for digital surfaces only (both or neither): the faces are the surfels' rectangles, with
  /// their corners in the order of kSurfelFrames, so that the closed form applies.
  std::span<const Surfel> surfels;
  Vec3 spacing{1., 1., 1.};  ///< edges of a voxel, world units

  /// V.
  Index vertices() const { return positions.size; }
  /// C, over all faces.
  Index corner_count() const { return static_cast<Index>(corners.size()); }
  /// F.
  Index faces() const {
    return offsets.empty() ? corner_count() / 4 : static_cast<Index>(offsets.size()) - 1;
  }
  /// The place in `corners` where those of the face begin; of face F, C.
  Index first_corner(Index face) const {
    return offsets.empty() ? 4 * face : offsets[static_cast<std::size_t>(face)];
  }
  /// The vertex ids of the corners of face f, 0 <= f < F.
  std::span<const VertexId> face(Index f) const {
    const Index first = first_corner(f);
    return corners.subspan(static_cast<std::size_t>(first),
                           static_cast<std::size_t>(first_corner(f + 1) - first));
  }
  /// Whether the calculus is the projected one.
  bool has_normals() const { return !normals.empty(); }
  /// Whether the faces are surfels, so that the closed form applies.
  bool is_digital() const { return !surfels.empty(); }
};

}  // namespace dsc
