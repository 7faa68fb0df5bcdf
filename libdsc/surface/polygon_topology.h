/// \file
/// How the faces of any polygon mesh meet, from its corners alone: no manifold is asked for.
///
/// Side c of a mesh runs from corner c to the next corner of its face. Sides whose two corners are
/// the same vertex belong to no edge.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/surface/digital_surface.h"

#include <vector>

namespace dsc {

/// Which sides of an edge are linked, where it has exactly two.
enum class SideLinks {
  any,      ///< whatever their directions
  opposed,  ///< where they run against each other, as in an oriented manifold
};

/// Per side the one that it is linked with, or -1: on boundary edges, on edges of more than two
/// sides, and where SideLinks says so. \throws InputError, LimitError as check_mesh(); Cancelled.
std::vector<VertexId> linked_sides(const FlatMesh& mesh, SideLinks which,
                                   const Context& context = {});

/// Per corner the first corner of its umbrella: the corners at a vertex that links join.
std::vector<VertexId> corner_umbrellas(const FlatMesh& mesh, const std::vector<VertexId>& links);

/// The counts of a polygon mesh, vertices without faces included, each a component of its own. A
/// pinched vertex is one whose corners fall into several umbrellas under SideLinks::any.
/// \throws as linked_sides().
SurfaceCounts count_polygons(const FlatMesh& mesh, const Context& context = {});

/// The number of vertices that no face has.
Index count_isolated_vertices(const FlatMesh& mesh);

}  // namespace dsc
