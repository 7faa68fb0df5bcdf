/// \file
/// Integral invariant curvatures: mean, Gaussian and principal ones, with their directions, from
/// the sums that give the normals (Pottmann et al. 2007; on digitised shapes: Coeurjolly, Lachaud,
/// Levallois 2013).
///
/// In the ball B of radius r around a surfel, let Vol be the volume of the shape, V its covariance
/// (integral_invariant.h) and n the eigenvector of V's smallest eigenvalue. A half space through
/// the centre has Vol_0 = Vol(B)/2 and, along tangents, the moments of V_0 = (1/2) int_B d d^T. The
/// excess over it, e_1 >= e_2 the extremes of V - V_0 on the tangent plane, gives
///
/// centred: \f$H = 12\,(\mathrm{Vol} - \mathrm{Vol}_0)/(\pi r^4) - 24\,(e_1 + e_2)/(\pi r^6)\f$,
/// \f$\kappa_{1,2} = H \mp 12\,(e_1 - e_2)/(\pi r^6)\f$;
///
/// plain: \f$H = -4\,(\mathrm{Vol} - \mathrm{Vol}_0)/(\pi r^4)\f$,
/// \f$\kappa_1 = 6\,(e_2 - 3 e_1)/(\pi r^6)\f$, \f$\kappa_2\f$ with e_1, e_2 exchanged;
///
/// kappa_1 <= kappa_2, kappa_1 along the direction of e_1. A centre at distance d outside the
/// surface adds about 4 d / r^2 to the plain H; in the centred form this cancels. So the centred
/// one converges on digitised surfaces for r = 3 h^(1/2), where the centres are off by about h.
///
/// On the lattice Vol_0 and V_0 are taken as half the sums over the whole digital ball. The lattice
/// is symmetric about a surfel's centre, so every plane through the centre that meets no lattice
/// point has exactly these, whatever its slope and the ball's radius: flat surfels have curvature
/// exactly 0, and only the offset and the curvature of the surface count. What a curvature adds is
/// measured by the disc in which the tangent plane cuts the ball, pi r^4/2 and pi r^6/3 being its
/// integrals of s^2 and s^4 (s the distance from the centre); the digital ball's discs have, on
/// average over all slopes, the sums of |d|/2 and |d|^3/2 over its points. With these for r^4 and
/// r^6, H at a radius of 6 or 8 voxels is 1 to 2 % off its limit, and 9 to 12 % without. (In the
/// continuum, Vol_0 = 2 pi r^3 / 3 and e_i = lambda_i - 2 pi r^5 / 15.)
///
/// The sums are exact integers, so the results have the same bits for any thread count. Where a
/// border cuts the object and nothing is assumed beyond, the cut is felt as an edge; continued
/// (Beyond), a plane stays a plane there, but a curved surface seems flatter than it is. The centre
/// of a thin part or of a sharp corner gives the average over the ball, of the order of 1/r.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/normals/integral_invariant.h"

#include <span>

namespace dsc {

/// Which of the two forms above.
enum class CurvatureForm {
  centred,  ///< the offset of the centre from the surface cancels
  plain,    ///< the volume's and the eigenvalues' own formulas; less noise, but a bias of 4 d / r^2
};

/// The radius must be given.
struct CurvatureOptions {
  double radius = 0;                            ///< world units; see radius.h
  CurvatureForm form = CurvatureForm::centred;  ///< see above
  Beyond beyond = Beyond::empty;                ///< what is outside the volume
};

/// One value a surfel, 1 / length (gaussian: its square), positive where the shape is convex.
/// No entry is ever NaN.
struct CurvatureField {
  Eigen::VectorXd mean;          ///< H = (kappa_1 + kappa_2) / 2
  Eigen::VectorXd gaussian;      ///< kappa_1 kappa_2
  Eigen::VectorXd kappa_1;       ///< the smaller principal curvature
  Eigen::VectorXd kappa_2;       ///< the larger one
  Eigen::Matrix3Xd direction_1;  ///< unit, across n, its sign arbitrary; along kappa_1
  Eigen::Matrix3Xd direction_2;  ///< n x direction_1
  Eigen::Matrix3Xd normals;      ///< n, as integral_invariant_normals() gives it
  Index fallbacks = 0;  ///< surfels where the ball defines no normal, and n is the surfel's own
  Index cut_faces = 0;  ///< surfels whose ball was continued beyond the volume
  double radius = 0;    ///< of the balls, world units
};

/// \throws UsageError on a radius that is not positive and finite, LimitError on one too large.
CurvatureField integral_invariant_curvatures(const BinaryVolume& volume,
                                             std::span<const Surfel> surfels,
                                             const CurvatureOptions& options,
                                             const Context& context = {});

}  // namespace dsc
