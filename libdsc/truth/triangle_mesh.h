/// \file
/// A triangle mesh as two arrays, with the checks and the refinement that ground truth needs.
#pragma once

#include "libdsc/base/types.h"
#include "libdsc/calculus/mesh_calculus.h"
#include "libdsc/surface/digital_surface.h"

#include <Eigen/Geometry>

#include <array>
#include <functional>
#include <vector>

/// What results are compared with: the library dsc::truth, on CGAL.
namespace dsc::truth {

/// The vertex ids of the three corners.
using Triangle = std::array<VertexId, 3>;

/// Corners run counter-clockwise seen from outside.
struct TriangleMesh {
  Eigen::Matrix3Xd vertices;    ///< 3 x V, world units
  std::vector<Triangle> faces;  ///< F

  /// V.
  Index vertex_count() const { return vertices.cols(); }
  /// F.
  Index face_count() const { return static_cast<Index>(faces.size()); }
  /// A view of the vertices.
  Vec3View positions() const { return {vertices.data(), vertices.cols()}; }
  /// Position of corner k, 0 to 2.
  Vec3 corner(Index face, int k) const {
    return vertices.col(faces[static_cast<std::size_t>(face)][static_cast<std::size_t>(k)]);
  }
  /// Half the cross product of two edges: the area times the unit normal.
  Vec3 area_vector(Index face) const {
    return 0.5 * (corner(face, 1) - corner(face, 0)).cross(corner(face, 2) - corner(face, 0));
  }
};

/// The mesh as write_result() and the calculus take it: `gathered(mesh).view()`.
GatheredMesh gathered(const TriangleMesh& mesh);

/// What polygon_topology.h counts, and two things more.
struct TriangleMeshCounts : SurfaceCounts {
  Index misoriented_edges = 0;  ///< edges that both their triangles run through in one direction
  Index unused_vertices = 0;    ///< vertices of no triangle, each a component of its own

  /// Whether it is a closed, consistently oriented 2-manifold.
  bool closed_manifold() const { return faces > 0 && boundary_edges == 0 && oriented_manifold(); }
  /// The same with a boundary.
  bool oriented_manifold() const {
    return nonmanifold_edges == 0 && misoriented_edges == 0 && pinched_vertices == 0 &&
           unused_vertices == 0;
  }
};

/// \throws InputError where a corner is not a vertex id.
TriangleMeshCounts count(const TriangleMesh& mesh);

/// Turns triangles so that neighbours agree and, in each component, the sum of
/// area_vector . outward(centroid) is positive. Edges with more than two triangles are not crossed;
/// count() reports what could not agree.
void orient(TriangleMesh& mesh, const std::function<Vec3(const Vec3&)>& outward);

/// Every triangle cut into four at its edges' midpoints. Vertices keep their ids; those of the
/// midpoints follow. Where an edge has more than two triangles, each gets a midpoint of its own.
/// \throws LimitError where corners pass 31 bits.
TriangleMesh subdivide(const TriangleMesh& mesh);

/// World units; 0 where there is no edge.
struct EdgeLengths {
  double longest = 0;  ///< of all edges
  double mean = 0;     ///< over all edges, each once
};
/// Measures every edge once.
EdgeLengths edge_lengths(const TriangleMesh& mesh);

}  // namespace dsc::truth
