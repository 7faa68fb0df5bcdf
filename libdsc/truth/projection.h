/// \file
/// The closest points of a smooth surface to points near it, such as those of its digitization.
///
/// Newton's method alone ends at the branch of the surface that its start leads to. Here the start
/// is the closest point of a dense mesh of all branches (smooth_mesh.h); Newton on
///     q - p + mu grad f(q) = 0,   f(q) = 0
/// then reaches rounding level, under the conditions of voxels/closest_point.h. Closed forms are
/// not used, so that this is independent of them.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/truth/mesh_tree.h"
#include "libdsc/voxels/closest_point.h"
#include "libdsc/voxels/implicit_shape.h"

namespace dsc::truth {

/// Projects onto the surface of one shape, with a mesh of it as guide.
class SurfaceProjection {
 public:
  /// `shape` must outlive this; `mesh` is a mesh of its surface, read only here.
  SurfaceProjection(const ImplicitShape& shape, const TriangleMesh& mesh)
      : shape_(&shape), tree_(mesh) {}

  /// Where it converged: a local minimum of the distance to p, no farther (up to 1e-5 of the
  /// shape's size) than the mesh's closest point moved onto the surface. Where two branches are
  /// equally close up to the mesh's distance from the surface, either. Safe from several threads.
  /// \throws InputError where p is not finite.
  ClosestPoint closest(const Vec3& p) const;

  /// All of them, in parallel; failures are counted and hold the best point found.
  ProjectedPoints project(Vec3View points, const Context& context = {}) const;

  /// Of the mesh that was given.
  const MeshTree& tree() const { return tree_; }

 private:
  const ImplicitShape* shape_;
  MeshTree tree_;
};

}  // namespace dsc::truth
