/// \file
/// From values on faces to values on vertices: the mean over the faces around each vertex, weighted
/// as M0 is, by each face's corrected area |u·e| area over its number of corners. Steep surfels, on
/// which estimates are poorest, count least.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/calculus/options.h"
#include "libdsc/surface/flat_mesh.h"

namespace dsc {

/// k × V from k × F. The same bits for any thread count; a vertex of no face gets zeros.
/// \throws UsageError where `values` has another number of columns than the mesh faces; InputError
/// where a value is not finite, and as assemble_laplacian().
Eigen::MatrixXd average_to_vertices(const FlatMesh& mesh,
                                    const Eigen::Ref<const Eigen::MatrixXd>& values,
                                    const CalculusOptions& options = {},
                                    const Context& context = {});

/// Normals at the vertices.
struct VertexNormals {
  Eigen::Matrix3Xd u;   ///< 3 × V, unit columns, but where undefined
  Index undefined = 0;  ///< vertices of no face, or where the normals cancel: u is zero
};
/// The averages of the mesh's estimated normals (of its own, where it has none), made unit vectors
/// again. \throws as assemble_laplacian().
VertexNormals vertex_normals(const FlatMesh& mesh, const CalculusOptions& options = {},
                             const Context& context = {});

}  // namespace dsc
