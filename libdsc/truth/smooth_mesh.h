/// \file
/// A triangle mesh of an implicit shape's surface, all of it, with every vertex on the surface.
///
/// CGAL's surface mesher makes a coarse mesh, which is cut in four with every new vertex snapped
/// to the surface until it has the edge length that is asked for: ten times faster than to mesh at
/// that length, and two meshes that differ by one such cut have errors in the ratio 4, which is
/// what an extrapolation needs.
///
/// Guaranteed of the result: a closed, manifold, consistently oriented mesh, normals outwards, with
/// |f| / |grad f| <= 1e-12 L at each vertex (L the diagonal of shape.bounds()), triangles facing
/// the way the surface does at their vertices, and the components and the Euler number of the
/// shape's digitization (digital_topology.h).
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/truth/triangle_mesh.h"
#include "libdsc/voxels/implicit_shape.h"

namespace dsc::truth {

/// The mesh, and what was checked of it.
struct SmoothMesh {
  TriangleMesh mesh;          ///< vertices on the surface
  TriangleMeshCounts counts;  ///< those of a closed manifold
  EdgeLengths edges;          ///< world units
  /// The smallest cosine between a triangle's normal and the surface's at one of its vertices.
  double worst_cosine = 0;
  int cuts = 0;         ///< from the mesher's triangles to these
  double gridstep = 0;  ///< the digitization that has the same topology
};

/// How fine the mesh is.
struct SmoothMeshOptions {
  /// Of the equilateral triangle whose circumcircle bounds every triangle's; most edges are
  /// shorter. Triangles are smaller where the surface bends within that length.
  double edge_length = 0.1;
  /// More are refused before the work, by the area.
  Index max_vertices = 20'000'000;
};

/// \throws UsageError where the shape is not closed or an option is out of its range, InputError
/// where the surface leaves bounds() or is empty, LimitError for more than max_vertices,
/// SolverError where the guarantee cannot be met (say, where the surface bends within much less
/// than an edge, or has a singular point).
SmoothMesh smooth_mesh(const ImplicitShape& shape, const SmoothMeshOptions& options,
                       const Context& context = {});

/// The same mesh with every triangle cut in four, new vertices snapped; checked as above.
SmoothMesh refine(const ImplicitShape& shape, const SmoothMesh& coarse,
                  const Context& context = {});

}  // namespace dsc::truth
