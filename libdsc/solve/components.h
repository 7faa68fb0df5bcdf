/// \file
/// Connected components of a mesh through shared vertex ids.
#pragma once

#include "libdsc/surface/flat_mesh.h"

#include <Eigen/Core>

#include <vector>

namespace dsc {

/// Components are numbered by their lowest vertex id, in ascending order. A vertex that no face
/// uses is a component of its own.
struct Components {
  std::vector<VertexId> of_vertex;  ///< V: the component of each vertex
  std::vector<VertexId> lowest;     ///< one a component: its lowest vertex id

  /// The number of components.
  Index count() const { return static_cast<Index>(lowest.size()); }
};

/// Two vertices are connected where some face has both among its corners: the blocks of the mesh's
/// Laplacian. \throws InputError where a corner is not a vertex id.
Components connected_components(const FlatMesh& mesh);

/// The mean of `x` (V) over each component, by the weights given (V, positive; empty: all 1).
Eigen::VectorXd component_means(const Components& components, const Eigen::VectorXd& weights,
                                const Eigen::VectorXd& x);

}  // namespace dsc
