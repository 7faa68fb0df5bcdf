/// \file
/// A digital surface: an OpenMesh polygon mesh, the side table that glues it, the surfels.
///
/// OpenMesh holds manifold connectivity only, so the mesh has one vertex per umbrella (the surfels
/// around a pointel, linked through shared linels under the adjacency), and, where two parallel
/// edges would join the same two vertices, a copy more. The side table gives for every face corner
/// its vertex id: the degree of freedom that scalar functions live on. Mesh vertices are numbered
/// so that vertex id i has its position at mesh vertex i; the further mesh vertices, beyond
/// vertex_count(), belong to vertex ids that the mesh had to split.
#pragma once

#include "libdsc/surface/adjacency.h"
#include "libdsc/surface/flat_mesh.h"
#include "libdsc/surface/surface_mesh.h"
#include "libdsc/voxels/grid.h"
#include "libdsc/voxels/label_volume.h"

#include <memory>
#include <span>

namespace dsc {

/// Counts of the surface glued by pointel, whatever the mesh had to split.
struct SurfaceCounts {
  Index vertices = 0;           ///< pointels
  Index edges = 0;              ///< linels
  Index faces = 0;              ///< surfels
  Index euler = 0;              ///< V - E + F
  Index components = 0;         ///< through shared pointels
  Index boundary_edges = 0;     ///< linels with exactly 1 surfel
  Index nonmanifold_edges = 0;  ///< linels with more than 2 surfels
  Index junction_edges = 0;     ///< of these, linels where more than 2 labels meet
  Index pinched_vertices = 0;   ///< pointels with more than one umbrella
};

/// The surface; made by extract_surface(), empty by default. A copy has a mesh, properties
/// included, of its own.
class DigitalSurface {
 public:
  DigitalSurface();
  /// The mesh with all its properties is copied.
  /// @{
  DigitalSurface(const DigitalSurface& other);
  DigitalSurface& operator=(const DigitalSurface& other);
  /// @}
  DigitalSurface(DigitalSurface&&) noexcept = default;
  DigitalSurface& operator=(DigitalSurface&&) noexcept = default;
  ~DigitalSurface() = default;

  /// The mesh; its properties carry normals and results. Do not change its connectivity.
  SurfaceMesh& mesh() { return *mesh_; }
  /// The same, to read.
  const SurfaceMesh& mesh() const { return *mesh_; }

  /// The grid of the volume that it was extracted from.
  const Grid& grid() const { return grid_; }
  /// As asked of extract_surface().
  /// @{
  Adjacency adjacency() const { return adjacency_; }
  Glue glue() const { return glue_; }
  /// @}

  /// What it is made of, counted when it was extracted.
  const SurfaceCounts& counts() const { return counts_; }

  /// The number of vertex ids V: the length of every scalar function on this surface.
  Index vertex_count() const { return vertex_count_; }
  /// The number of surfels F.
  Index face_count() const { return counts_.faces; }

  /// Per face the vertex ids of its corners: the side table.
  std::span<const QuadCorners> corners() const;
  /// Per face its surfel.
  std::span<const Surfel> surfels() const;
  /// Per face the labels inside and outside; empty where the surface is not of a label volume.
  std::span<const LabelPair> labels() const;

  /// World position of vertex id v: its pointel.
  Vec3 position(VertexId v) const {
    const auto& p = mesh_->points()[v];
    return {p[0], p[1], p[2]};
  }
  /// World positions of all vertex ids, in their order.
  Vec3View positions() const {
    return {vertex_count_ == 0 ? nullptr : mesh_->points()->data(), vertex_count_};
  }

  /// The face property `dsc:normal` , one a face; empty where no estimator has written it.
  Vec3View normals() const;
  /// Writes `dsc:normal`. `u` is 3 x F, unit columns. \throws UsageError on another shape.
  void set_normals(const Eigen::Ref<const Eigen::Matrix3Xd>& u);
  /// Removes `dsc:normal`, where it is: flat() then gives the naive calculus.
  void remove_normals();

  /// What the calculus reads; the view lives as long as this surface. Where `with_normals` is
  /// false, the naive calculus results.
  FlatMesh flat(bool with_normals = true) const;

 private:
  friend class SurfaceBuilder;

  std::unique_ptr<SurfaceMesh> mesh_;  ///< OpenMesh's meshes do not move, they copy
  OpenMesh::FPropHandleT<QuadCorners> corners_;
  OpenMesh::FPropHandleT<Surfel> surfels_;
  OpenMesh::FPropHandleT<LabelPair> labels_;  ///< invalid where there are none
  Grid grid_;
  Adjacency adjacency_ = Adjacency::interior;
  Glue glue_ = Glue::pointel;
  Index vertex_count_ = 0;
  SurfaceCounts counts_;
};

}  // namespace dsc
