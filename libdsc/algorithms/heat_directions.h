/// \file
/// \internal
/// The directions in which heat decreases, d = -G w / |G w| per face.
///
/// Where fronts meet head on, G w vanishes and its direction is noise. So that noise stays small,
/// the length is taken as hypot(|G w|, ε), with ε far below every gradient that heat of time t has
/// away from such places: d shrinks to 0 there instead of flipping, and is a unit vector to 1e-9
/// elsewhere.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/calculus/options.h"
#include "libdsc/solve/wide_vector.h"
#include "libdsc/surface/flat_mesh.h"

namespace dsc {

struct HeatDirections {
  Eigen::Matrix3Xd d;        ///< 3 x F, unit vectors away from the sources, or shorter
  Index flat_faces = 0;      ///< |d| < 1/2 though heat arrives: nearly the same at all corners
  Index cold_faces = 0;      ///< d = 0 because w is 0 at all corners
  Index negative_faces = 0;  ///< with a corner where w < 0; |w| counts there
};

/// Each face's w is divided by its own largest entry first, so that neither w nor its square
/// underflows. `t` is the time of diffusion. \throws UsageError where w has another length than V,
/// and as face_gradients does.
HeatDirections heat_directions(const FlatMesh& mesh, const WideVector& w, double t,
                               const CalculusOptions& options = {}, const Context& context = {});

}  // namespace dsc
