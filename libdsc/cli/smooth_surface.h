/// \file
/// The smooth surface behind the voxels, as far as it is known: where functions are sampled and
/// positions differentiated.
#pragma once

#include "libdsc/cli/stages.h"

namespace dsc::cli {

/// Points of the smooth surface, one a vertex, and the mesh whose operators belong to them.
///
/// Of a shape, its points closest to the vertices, under the calculus that the options ask for. Of
/// voxels, regularised positions, under the calculus of the mesh that has them; without normals
/// (the naive calculus) the vertices as they are. A mesh is taken for smooth.
struct SmoothSurface {
  Eigen::Matrix3Xd positions;  ///< 3 × V
  FlatMesh mesh;               ///< looks at `positions` or at the scene's surface

  SmoothSurface() = default;
  SmoothSurface(SmoothSurface&&) = default;  // the buffer of `positions` stays where it is
  SmoothSurface& operator=(SmoothSurface&&) = default;

  Vec3View points() const { return {positions.data(), positions.cols()}; }
};

/// Warns of closest points that were not found, and notes in the report what was done. The scene
/// must outlive the result.
SmoothSurface smooth_surface(const Scene& scene, Run& run);

/// The scene's surface with regularised positions, without normals and surfels. \throws InputError
/// where a mesh has no normals.
SmoothSurface regularised_surface(const Scene& scene, Run& run);

/// The points of the shape closest to the vertices, or to the centres of the faces, with the same
/// warning.
Eigen::Matrix3Xd project_vertices(const Scene& scene, Run& run);
Eigen::Matrix3Xd project_face_centres(const Scene& scene, Run& run);

/// f at points of the surface, which the expression sees in the world.
Eigen::VectorXd sample(const Expression& f, Vec3View points, const Scene& scene, const Run& run);

}  // namespace dsc::cli
