/// \file
/// Where a surface ends.
#pragma once

#include "libdsc/surface/flat_mesh.h"

#include <vector>

namespace dsc {

/// V flags: 1 at the vertices of edges (pairs of vertex ids that follow one another in a face) with
/// exactly one face, 0 elsewhere. All 0 on a closed surface, pinched or not.
/// \throws InputError where a corner is not a vertex id.
std::vector<char> boundary_vertices(const FlatMesh& mesh);

}  // namespace dsc
