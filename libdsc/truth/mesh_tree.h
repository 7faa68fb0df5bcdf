/// \file
/// The closest point of a triangle mesh, by CGAL's tree of boxes.
#pragma once

#include "libdsc/truth/triangle_mesh.h"

#include <memory>

namespace dsc::truth {

/// A point of a mesh: face and barycentric coordinates, non-negative, of sum 1.
struct MeshPoint {
  Index face = -1;                  ///< of the mesh; -1: none
  Vec3 barycentric = Vec3::Zero();  ///< weights of its corners
  Vec3 point = Vec3::Zero();        ///< world units
};

/// The triangles of one mesh, sorted in space.
class MeshTree {
 public:
  /// Triangles without area are left out: their sides belong to neighbours, too. The mesh is
  /// copied. \throws InputError where no triangle has an area or a position is not finite.
  explicit MeshTree(const TriangleMesh& mesh);
  MeshTree(MeshTree&&) noexcept;
  MeshTree& operator=(MeshTree&&) noexcept;
  ~MeshTree();

  /// The closest point up to rounding; where several are, one of them. Safe from several threads.
  /// \throws InputError where p is not finite.
  MeshPoint closest(const Vec3& p) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace dsc::truth
