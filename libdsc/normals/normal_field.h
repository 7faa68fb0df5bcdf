/// \file
/// What every normal estimator returns.
#pragma once

#include "libdsc/base/types.h"

namespace dsc {

/// One unit normal a face, pointing outwards. No entry is ever NaN.
struct NormalField {
  Eigen::Matrix3Xd u;   ///< 3 x F, unit columns
  Index fallbacks = 0;  ///< faces where the estimator had no answer and u is the face's own normal
  Index cut_faces = 0;  ///< faces whose ball was continued beyond the volume (continued_ball.h)
  double radius = 0;    ///< world radius of the estimator's neighbourhood; 0 where it has none
};

}  // namespace dsc
