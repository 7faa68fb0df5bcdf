/// \file
/// \internal
/// From linked surfels to a halfedge mesh.
///
/// A builder is filled with faces (their surfels, the vertex ids of their corners), positions, and
/// the links between sides; finish() writes the halfedge connectivity directly, in parallel,
/// without OpenMesh's add_face with its search and its rejections. No face is ever lost: where the
/// links make a vertex that a halfedge mesh cannot hold, the mesh gets one vertex more, not one
/// face less.
///
/// Used by extraction from binary and from label volumes, and of parts.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/topology.h"

#include <memory>
#include <span>
#include <vector>

namespace dsc {

class SurfaceBuilder {
 public:
  /// Room for `faces` faces and `vertices` pointels. `whole`: no part() will be taken, so that
  /// make_edges() may make the edges. \throws LimitError beyond 32-bit ids or the context's memory.
  SurfaceBuilder(const Grid& grid, Index vertices, Index faces, bool with_labels, bool whole,
                 const Context& context);

  /// Makes the edges that a whole surface has at least, two a face; finish() adds those missing.
  /// That takes one thread some time, but others may fill the spans below meanwhile.
  void make_edges();

  std::span<Surfel> surfels();
  std::span<LabelPair> labels();           ///< empty without labels
  std::span<QuadCorners> corners();        ///< pointel ids in [0, vertices)
  std::span<OpenMesh::Vec3d> positions();  ///< world positions of the pointels
  /// Per side code the code of the side that it is linked to, or kNoSide. Symmetric; a side is
  /// linked to one that runs along the same linel the other way.
  std::span<topology::SideCode> opposite() {
    return {opposite_.get(), 4 * surface_.mesh().n_faces()};
  }
  /// Every linel with more than two surfels, or with two that are not linked.
  std::vector<topology::Junction>& junctions() { return junctions_; }

  /// The surface of the faces f with keep[f] != 0 alone. Sides whose partner goes are unlinked; two
  /// sides that are left alone at a linel are linked where their directions allow.
  SurfaceBuilder part(const std::vector<std::uint8_t>& keep, const Context& context) &&;

  /// \throws LimitError beyond the context's memory.
  DigitalSurface finish(Adjacency adjacency, Glue glue, const Context& context) &&;

 private:
  DigitalSurface surface_;
  bool whole_;
  std::unique_ptr<topology::SideCode[]> opposite_;  ///< not cleared: every side is written
  std::vector<topology::Junction> junctions_;
};

}  // namespace dsc
