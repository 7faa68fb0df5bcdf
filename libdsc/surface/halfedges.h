/// \file
/// \internal
/// Writes OpenMesh's halfedge connectivity from linked sides.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/surface/surface_mesh.h"
#include "libdsc/surface/topology.h"

#include <span>

namespace dsc::topology {

/// Resizes the mesh to leaders.size() vertices and its edges, and writes every halfedge.
///
/// `corners`: the pointel of each face corner; `opposite`: the links; `leaders[v]`: a corner of
/// mesh vertex v, the start of its chain where the umbrella is open. The orbits of corners under
/// the links must be the vertices, one each; those of vertices below `pointels` are of the pointel
/// of the same number. Positions and properties of existing vertices are kept.
void write_halfedges(SurfaceMesh& mesh, std::span<const QuadCorners> corners,
                     std::span<const SideCode> opposite, std::span<const SideCode> leaders,
                     Index pointels, const Context& context);

}  // namespace dsc::topology
