/// \file
/// \internal
/// Which vertices the halfedge mesh of a digital surface gets: one an umbrella, and copies where
/// two parallel edges would join the same two.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/surface/surface_mesh.h"
#include "libdsc/surface/topology.h"

#include <span>
#include <vector>

namespace dsc::topology {

/// The first umbrella of pointel p is mesh vertex p; then come the further umbrellas, by pointel;
/// then the copies.
struct MeshVertices {
  std::vector<SideCode> leaders;     ///< per mesh vertex, the leader of its orbit under the links
  Index pointels = 0;                ///< mesh vertices [0, pointels) are the pointels' own
  Index umbrellas = 0;               ///< mesh vertices [0, umbrellas) are one an umbrella
  Index pinched = 0;                 ///< pointels with more than one umbrella
  std::vector<VertexId> pointel_of;  ///< of mesh vertices pointels + k
  std::vector<VertexId> umbrella_of_copy;  ///< of mesh vertices umbrellas + k

  /// The umbrella of mesh vertex v, as its number.
  VertexId umbrella_of(Index v) const {
    return v < umbrellas ? static_cast<VertexId>(v)
                         : umbrella_of_copy[static_cast<std::size_t>(v - umbrellas)];
  }
};

/// Numbers the mesh vertices. `corners` holds pointels in [0, pointels).
///
/// Two edges at one linel that would join the same two vertices are linked the other way round in
/// `opposite`, which splits the umbrellas at both their ends: exchanging the partners of two sides
/// that one orbit crosses cuts that orbit in two.
MeshVertices number_mesh_vertices(std::span<const QuadCorners> corners, Index pointels,
                                  std::span<SideCode> opposite, std::span<const Junction> junctions,
                                  const Context& context);

}  // namespace dsc::topology
