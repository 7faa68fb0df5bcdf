/// \file
/// \internal
/// From a covariance to the normal of a surfel, and the count of those that have none.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/normals/normal_field.h"
#include "libdsc/surface/surfel.h"

#include <span>

namespace dsc {

/// The unit eigenvector of the smallest eigenvalue of `v`, oriented like `outward`; zero where it
/// is not unique or at a right angle to `outward`.
Vec3 flattest_direction(const Mat3& v, const Vec3& outward);

/// Gives the faces whose normal is zero their own, and counts them in `fallbacks`.
void fall_back(NormalField& field, std::span<const Surfel> surfels, const Context& context);

}  // namespace dsc
