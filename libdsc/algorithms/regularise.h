/// \file
/// Regularised positions: a smooth surface with the corners of a digital one.
///
/// The pointels p of a digital surface lie within about a gridstep of the surface behind them, but
/// its squares have no slope but the axes'. The positions p̂ that minimise
///
/// \f[ \alpha \sum_v |p - \hat p|^2 + \beta \sum_f \sum_{e \in \partial f} (\hat e \cdot u_f)^2
///      + \gamma \sum_v |\hat p - \hat b|^2 \f]
///
/// stay near them (α), make each face stand across its estimated normal u_f (β; ê are the edges
/// between unknown positions), and spread evenly (γ; b̂ is the mean of the unknown neighbours along
/// edges). The energy is convex and quadratic, every term a length squared: the minimum is unique,
/// and moves and scales with the surface. (Coeurjolly, Gueth, Lachaud: Regularization of voxel art,
/// 2018, and Digital surface regularization by normal vector field alignment, 2017.)
///
/// One change: where the surface ends, b̂ is the mean along the boundary, since the neighbours on
/// one side would draw the boundary in.
///
/// Vertices are vertex ids, their neighbours those of the side table, so that junctions and pinched
/// places stay shared. A vertex of no face stays where it is.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/surface/flat_mesh.h"

namespace dsc {

/// The weights of the energy, which have no unit, and how exact the minimum is.
struct RegulariseOptions {
  double alpha = 0.001;  ///< nearness; > 0
  double beta = 1.;      ///< alignment with the normals; >= 0
  double gamma = 0.05;   ///< fairness; >= 0
  /// The root mean square, over the vertices, of how far the result may lie from the exact minimum,
  /// in mean edge lengths; > 0. Guaranteed, since the energy's Hessian is at least 2 α.
  double accuracy = 1e-3;

  /// \throws UsageError naming the option that is out of its range.
  void check() const;
};

/// The positions, and how far they lie from those given.
struct RegularisedPositions {
  Eigen::Matrix3Xd positions;       ///< 3 × V, world units
  double mean_displacement = 0;     ///< of |p − p̂|
  double largest_displacement = 0;  ///< world units, as the mean
  Index iterations = 0;             ///< of conjugate gradients
};

/// Of the mesh's positions under its normals.
///
/// Conjugate gradients on the 3 V unknowns, preconditioned by the 3 × 3 block of each vertex; the
/// matrix is not stored. The same bits for any thread count.
/// \throws UsageError where the mesh has no normals or an option is out of range; InputError naming
/// the face with a corner that is no vertex or a normal that is no unit vector; SolverError.
RegularisedPositions regularise_positions(const FlatMesh& mesh,
                                          const RegulariseOptions& options = {},
                                          const Context& context = {});

}  // namespace dsc
