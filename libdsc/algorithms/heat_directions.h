/// \file
/// The directions in which heat decreases: d = -G w / |G w| per face.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/calculus/options.h"
#include "libdsc/solve/wide_vector.h"
#include "libdsc/surface/flat_mesh.h"

namespace dsc {

struct HeatDirections {
  Eigen::Matrix3Xd d;    ///< 3 x F, unit vectors away from the sources, or 0
  Index flat_faces = 0;  ///< d = 0 though heat arrives: w is the same at all corners to 1e-12
  Index cold_faces = 0;  ///< d = 0 because w is 0 at all corners
};

/// Each face's w is divided by its own largest entry first, so that neither w nor its square
/// underflows. \throws UsageError where w has another length than V, and as face_gradients does.
HeatDirections heat_directions(const FlatMesh& mesh, const WideVector& w,
                               const CalculusOptions& options = {}, const Context& context = {});

}  // namespace dsc
