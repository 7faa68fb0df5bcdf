/// \file
/// \internal
/// Moments of a ball that reaches beyond the volume, where the object goes on.
///
/// Nothing is known there, and emptiness would be felt as an edge of the object: normals near the
/// border tilt by tens of degrees. So what is beyond is filled in from the other side of the
/// centre, d in the shape if -d is not: exact for every plane through the centre, and right to
/// first order for a smooth surface. Points beyond whose mirror image is beyond too are left out,
/// which is symmetric.
#pragma once

#include "libdsc/normals/ball_moments.h"

namespace dsc {

/// Whether some row of the ball at `centre` (doubled) has voxels outside the grid.
bool reaches_beyond(const Grid& grid, const BallRows& rows, const Index3& centre);

/// The moments of the ball at `centre`, filled in beyond the volume. Precondition: `centre` has the
/// rows' parity.
BallMoments continued_moments(const BinaryVolume& volume, const BallRows& rows,
                              const Index3& centre);

}  // namespace dsc
