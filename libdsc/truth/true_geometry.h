/// \file
/// What a digital surface's estimates are compared with: normals and curvatures of the smooth
/// surface, from its function's derivatives (voxels/implicit_curvature.h).
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/voxels/implicit_shape.h"

namespace dsc::truth {

/// One entry a point. Signs as everywhere: normals outwards, a sphere of radius r has mean
/// curvature +1/r.
struct TrueGeometry {
  Eigen::Matrix3Xd normals;  ///< unit, outwards
  Eigen::VectorXd mean;      ///< 1 / length
  Eigen::VectorXd gaussian;  ///< 1 / length squared
  Index failures = 0;        ///< points where the gradient vanishes; they hold zeros
};

/// At points of the surface, such as projection.h gives. In parallel. \throws InputError where an
/// expression cannot be evaluated.
TrueGeometry true_geometry(const ImplicitShape& shape, Vec3View points,
                           const Context& context = {});

}  // namespace dsc::truth
