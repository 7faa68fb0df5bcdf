/// \file
/// What every assembler checks of a FlatMesh before it computes, and how it names a face.
#pragma once

#include "libdsc/calculus/options.h"
#include "libdsc/surface/flat_mesh.h"

#include <string>

namespace dsc {

/// Checks the sizes of the arrays against one another, O(1) but for the corner offsets.
/// \throws InputError where they disagree, a face has fewer than 3 corners or the spacing is not
/// positive; UsageError where the stabilization is for rectangles and the mesh has none;
/// LimitError where corners pass 31 bits.
void check_mesh(const FlatMesh& mesh, const CalculusOptions& options);

/// "face 17 (near 1, 2.5, -3)".
std::string face_name(const FlatMesh& mesh, Index face);

/// \throws InputError about the face's estimated normal.
[[noreturn]] void refuse_normal(const FlatMesh& mesh, Index face);
/// \throws InputError: `v`, a corner of the face, is no vertex.
[[noreturn]] void refuse_vertex(const FlatMesh& mesh, Index face, VertexId v);
/// \throws InputError: the face has no area.
[[noreturn]] void refuse_area(const FlatMesh& mesh, Index face);
/// \throws InputError: the direction of its surfel is none of 0 to 5.
[[noreturn]] void refuse_direction(const FlatMesh& mesh, Index face);

/// Whether `area` is one, for a face whose edges have `scale` as their sum of squares: finite, and
/// more than the rounding of its own cross products.
inline bool is_area(double area, double scale) { return area > 1e-14 * scale && area - area == 0.; }

/// \throws InputError where `v` is not a vertex of the mesh.
inline void check_vertex(const FlatMesh& mesh, Index face, VertexId v) {
  if (v < 0 || v >= mesh.vertices()) refuse_vertex(mesh, face, v);
}

}  // namespace dsc
