/// \file
/// Shapes on which exact answers are known, to measure errors against.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/voxels/expression.h"
#include "libdsc/voxels/implicit_shape.h"

#include <optional>
#include <span>

namespace dsc::cli {

/// The exact distance, along the surface of `shape`, from each of `points` to the nearest of
/// `sources`, all taken to the surface first: the great circle on a sphere, the straight line on a
/// plane. Nothing for other shapes.
std::optional<Eigen::VectorXd> known_distances(const ImplicitShape& shape, Vec3View points,
                                               const Eigen::Matrix3Xd& sources,
                                               const Context& context);

/// The gradient of f restricted to the surface, at the closest point of each of `points`: the
/// tangential part of f's gradient there.
struct KnownGradients {
  Eigen::Matrix3Xd gradients;
  Index failures = 0;  ///< points whose closest point was not found
};
KnownGradients known_gradients(const ImplicitShape& shape, const Expression& f, Vec3View points,
                               const Context& context);

}  // namespace dsc::cli
