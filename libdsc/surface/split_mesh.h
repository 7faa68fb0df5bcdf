/// \file
/// Any polygon mesh as an OpenMesh mesh: split where its faces form no oriented manifold.
///
/// OpenMesh holds manifold connectivity only. Edges of more than two faces, and of two that
/// disagree on the orientation, are cut; a vertex gets one copy for each umbrella that is left; a
/// face that still does not fit is cut off. A table says what the copies are copies of.
#pragma once

#include "libdsc/surface/flat_mesh.h"
#include "libdsc/surface/surface_mesh.h"

#include <vector>

namespace dsc {

/// Fills the empty `mesh` with the positions and faces of `polygons`, in their order.
/// \return per mesh vertex the vertex that it copies; the first are 0, 1, 2, … themselves.
/// \throws InputError where a corner is no vertex or a face has fewer than 3; LimitError.
std::vector<VertexId> split_mesh(const FlatMesh& polygons, SurfaceMesh& mesh);

}  // namespace dsc
