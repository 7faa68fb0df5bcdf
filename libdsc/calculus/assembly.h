/// \file
/// The global Laplacian and mass of a surface, from its corners and estimated normals.
///
/// \f$L = \sum_f L_f\f$ and \f$M_0 = \sum_f \frac{a_f}{n_f} I\f$, summed by vertex id. Surfels use
/// the closed form of surfel_operators.h, other meshes the general polygon. L is the weak
/// (integrated) operator: M0⁻¹L approximates the Laplace-Beltrami operator; L is symmetric to the
/// last bit and negative semi-definite, with the constants of every connected component in its
/// kernel.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/calculus/options.h"
#include "libdsc/surface/flat_mesh.h"

namespace dsc {

/// L and M0 of one surface under one set of options.
struct LaplaceSystem {
  SparseMatrix L;           ///< V × V, both triangles stored, columns sorted
  Eigen::VectorXd mass;     ///< diagonal of M0; sums to the projected area
  Index clamped_faces = 0;  ///< faces whose normal was tilted back (embedding.h)
};

/// Assembles L and M0 of `mesh`; without normals, the naive calculus.
///
/// The same bits for any thread count. A vertex of no face gets an empty row and mass 0.
/// \throws InputError naming the face that has no area, a corner outside the vertices or a normal
/// that is not a unit vector; UsageError on options out of range; LimitError where corners or
/// nonzeros pass 31 bits. For several fills of one surface see LaplacianPattern.
LaplaceSystem assemble_laplacian(const FlatMesh& mesh, const CalculusOptions& options = {},
                                 const Context& context = {});

}  // namespace dsc
