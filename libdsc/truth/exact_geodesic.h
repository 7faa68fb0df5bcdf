/// \file
/// Exact geodesic distances on a triangle mesh (Xin and Wang's improvement of Chen and Han's
/// algorithm, in CGAL), and from them distances on the smooth surface by extrapolation.
///
/// A mesh with its vertices on a smooth surface has distances that differ from the surface's by
/// c e^2 in the edge length e. Cut in four (smooth_mesh.h) it has half the edge length and the same
/// shape, so (4 fine - coarse) / 3 cancels that term.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/truth/mesh_tree.h"
#include "libdsc/voxels/implicit_shape.h"

#include <memory>

namespace dsc::truth {

/// Memory and time grow beyond use above this: 318 000 vertices take 5 GB and a minute a source.
inline constexpr Index kMaxGeodesicVertices = 100'000;

/// Distances on one mesh, from any points of it.
class ExactGeodesic {
 public:
  /// A closed or bounded manifold mesh; it is copied. \throws LimitError above
  /// kMaxGeodesicVertices, InputError where it is not manifold or not consistently oriented.
  explicit ExactGeodesic(const TriangleMesh& mesh);
  ExactGeodesic(ExactGeodesic&&) noexcept;
  ExactGeodesic& operator=(ExactGeodesic&&) noexcept;
  ~ExactGeodesic();

  /// The length of the shortest path along the mesh from `source` to each query, both taken at the
  /// closest points of the mesh; +infinity on components without the source. Exact up to 1e-9 of an
  /// edge and rounding.
  /// \throws SolverError where CGAL fails.
  Eigen::VectorXd distances(const Vec3& source, Vec3View queries,
                            const Context& context = {}) const;

 private:
  struct Mesh;
  std::unique_ptr<Mesh> mesh_;
};

/// A value a query, and how far the meshes are from the limit.
struct SurfaceDistances {
  Eigen::VectorXd distance;  ///< (4 fine - coarse) / 3; +infinity where unreachable
  Eigen::VectorXd coarse;    ///< on the mesh of the edge length that was asked for
  Eigen::VectorXd fine;      ///< on that mesh, cut in four
  Index fine_vertices = 0;   ///< of the mesh cut in four
  /// The largest |distance - fine| over finite distances: the error of `fine`, about; that of
  /// `distance` is a fraction of it.
  double correction = 0;
};

/// Geodesic distances on the surface of a closed shape. `source` and `queries` lie on or near it.
/// \throws as smooth_mesh() and ExactGeodesic: the fine mesh has about four times the vertices of
/// smooth_mesh(shape, {edge_length}), and kMaxGeodesicVertices holds for it.
SurfaceDistances surface_distances(const ImplicitShape& shape, double edge_length,
                                   const Vec3& source, Vec3View queries,
                                   const Context& context = {});

}  // namespace dsc::truth
