/// \file
/// Integral invariant normals: the flattest direction of the shape within a ball.
///
/// At a surfel,
/// \f[ V = h_x h_y h_z \sum_p (p - \bar p)(p - \bar p)^T \f]
/// over the voxels p of the set in the ball of world radius r, their mean \f$\bar p\f$; u is the
/// eigenvector of its smallest eigenvalue, oriented like the surfel (Pottmann et al. 2007;
/// convergent on digitised shapes: Lachaud, Coeurjolly, Levallois 2017). The sums are exact
/// integers (ball_moments.h), so u has the same bits for any thread count.
///
/// Where a border cuts the object and nothing is assumed beyond, u feels the cut; see Beyond.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/normals/ball_moments.h"
#include "libdsc/normals/normal_field.h"
#include "libdsc/surface/surfel.h"
#include "libdsc/voxels/binary_volume.h"

#include <functional>
#include <span>

namespace dsc {

/// Where the balls of a surfel are centred.
enum class BallCentre {
  surfel,      ///< one ball, centred on the surfel
  voxel_pair,  ///< DGtal's: the average of the covariances of two, centred on the inner and outer
               ///< voxel
};

/// What the balls find outside the volume.
enum class Beyond {
  empty,      ///< nothing: the object ends where the volume ends
  continued,  ///< the object goes on, where its surface was left open (continued_ball.h)
};

/// The radius must be given.
struct IntegralInvariantOptions {
  double radius = 0;                       ///< world units; see radius.h
  BallCentre centre = BallCentre::surfel;  ///< see BallCentre
  Beyond beyond = Beyond::empty;           ///< what is outside the volume
};

/// One normal a surfel.
///
/// A surfel keeps its own normal, and is counted in `fallbacks`, where the ball has no voxel, where
/// the smallest eigenvalue is not simple (a single voxel, a line of voxels), or where u is at a
/// right angle to the surfel, so that its orientation is open. \throws UsageError on a radius that
/// is not positive and finite, LimitError on one too large.
NormalField integral_invariant_normals(const BinaryVolume& volume, std::span<const Surfel> surfels,
                                       const IntegralInvariantOptions& options,
                                       const Context& context = {});

/// Gets the moments of surfel i: of one ball, or for voxel_pair of the inner and the outer one,
/// each relative to its own centre.
using BallVisitor = std::function<void(Index i, std::span<const BallMoments> balls)>;

/// Calls visit for every surfel, each once, from many threads in any order. Returns the number of
/// surfels with balls that were continued beyond the volume. \throws as above.
Index visit_balls(const BinaryVolume& volume, std::span<const Surfel> surfels,
                  const IntegralInvariantOptions& options, const BallVisitor& visit,
                  const Context& context = {});

}  // namespace dsc
