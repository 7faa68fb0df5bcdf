/// \file
/// \internal
/// CGAL's surface mesher (restricted Delaunay refinement) on an implicit shape. Private:
/// call smooth_mesh().
#pragma once

#include "libdsc/truth/triangle_mesh.h"
#include "libdsc/voxels/implicit_shape.h"

namespace dsc::truth::detail {

/// Triangles with angles of at least 30 degrees, circumradii of at most edge / sqrt(3) (that of the
/// equilateral triangle) and circumcentres within `distance` of the surface, so that triangles are
/// smaller where the surface bends more. Vertices lie on it up to 1e-9 of its size. Only components
/// that `seeds`, points on the surface, meet are found. Faces are not oriented yet. \throws
/// SolverError where CGAL gives up.
TriangleMesh mesh_surface(const ImplicitShape& shape, Vec3View seeds, double edge, double distance);

}  // namespace dsc::truth::detail
