/// \file
/// Gradients and divergences of whole fields, face by face, without a matrix.
///
///     gradient:    scalar per vertex  → vector per face,    (G_f φ)_f
///     divergence:  vector per face    → scalar per vertex,  Σ_f Div_f V_f d_f = −Σ_f a_f G_fᵀ d_f
/// so that Green's formula holds,
/// \f[ \sum_v \varphi(v)\,\mathrm{div}(v) = -\sum_f a_f\,(G_f \varphi) \cdot d_f. \f]
/// Both have the same bits for any thread count.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/calculus/options.h"
#include "libdsc/surface/flat_mesh.h"

namespace dsc {

/// G φ: 3 × F, per face the gradient of `phi` (V values), in φ's unit over length, across the
/// estimated normal u.
///
/// \throws UsageError where phi has another length than V; InputError where φ is not finite at a
/// corner, and as assemble_laplacian().
Eigen::Matrix3Xd face_gradients(const FlatMesh& mesh, const Eigen::VectorXd& phi,
                                const CalculusOptions& options = {}, const Context& context = {});

/// The integrated divergence at every vertex of `vectors` (3 × F); the part of a vector along the
/// face's estimated normal has no effect.
/// \throws UsageError where `vectors` has another shape than 3 × F; InputError where a vector is
/// not finite, and as assemble_laplacian().
Eigen::VectorXd integrated_divergence(const FlatMesh& mesh, const Eigen::Matrix3Xd& vectors,
                                      const CalculusOptions& options = {},
                                      const Context& context = {});

}  // namespace dsc
