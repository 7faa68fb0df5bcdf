/// \file
/// Whether the answers known for a shape are those of the surface at hand.
#pragma once

#include "libdsc/cli/stages.h"

namespace dsc::cli {

/// The shape to measure errors against. Nothing, after a warning that tells why, where faces lie on
/// the sides of the box that cuts the shape: the surface is then the shape's only in part. Nothing
/// where there is no shape.
const ImplicitShape* measured_shape(const Scene& scene, Run& run);

/// The centres of the faces.
Eigen::Matrix3Xd face_centres(const DigitalSurface& surface);

/// Warns where the report's error leaves values out.
void warn_of_left_out(Run& run);

}  // namespace dsc::cli
