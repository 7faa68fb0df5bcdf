/// \file
/// Mean curvature from the Laplacian of the positions,
/// \f$H = -\tfrac12 M_0^{-1}\,[LX\;LY\;LZ] \cdot u\f$, u the estimated normals averaged to
/// vertices. Positive where the surface is convex.
///
/// X must lie near the smooth surface: with the pointels of a digital surface H is meaningless, its
/// error grows like 1/h. Two ways:
/// - where the shape is known, the closest points of the pointels (closest_point.h), under the
///   operators of the digital surface with its estimated normals;
/// - elsewhere, regularised positions (regularise.h), under the operators of the mesh that has
/// them,
///   without surfels. They have moved along the surface too, so that the digital surface's own
///   operators are wrong for them.
/// Diffused for a short time T, by one implicit step (M0 − T L) H̃ = M0 H, the error falls further;
/// √T is the radius that is averaged over.
///
/// The stabilisation matters here. Without any (Stabilization::mercat) H converges pointwise on
/// projected positions: root mean square errors of 0.030, 0.020, 0.011 on the unit sphere at h =
/// 0.1, 0.05, 0.025. With λ = 0.25 it does not (0.14, 0.16, 0.15), and H is 3 to 4 % too large on
/// average at any h. The checkerboard that λ = 0 leaves in the kernel of L does no harm: nothing is
/// solved with L alone.
#pragma once

#include "libdsc/algorithms/laplace_beltrami.h"
#include "libdsc/calculus/vertex_average.h"
#include "libdsc/surface/flat_mesh.h"

namespace dsc {

/// H at the vertices.
struct MeanCurvature {
  Eigen::VectorXd mean;  ///< V, 1 / length
  /// Vertices of no face, or around which the normals cancel; their H is 0 before the diffusion.
  Index undefined_vertices = 0;
  Index clamped_faces = 0;       ///< of the calculus
  double relative_residual = 0;  ///< of the diffusion
};

/// `mesh` gives the operators and normals, `positions` (V) X. \throws UsageError where there are
/// not V positions; InputError where a position is not finite; and as LaplaceBeltrami does. The
/// time of `options` is T.
MeanCurvature mean_curvature(const FlatMesh& mesh, Vec3View positions,
                             const LaplaceBeltramiOptions& options, const Context& context = {});

/// The same with the normals u at vertices (3 × V, unit or zero) given apart, whatever the mesh's.
MeanCurvature mean_curvature(const FlatMesh& mesh, Vec3View positions, const VertexNormals& normals,
                             const LaplaceBeltramiOptions& options, const Context& context = {});

}  // namespace dsc
