/// \file
/// Shapes on which exact answers are known, to measure errors against.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/voxels/expression.h"
#include "libdsc/voxels/implicit_shape.h"

#include <optional>
#include <vector>

namespace dsc::cli {

/// The exact distance, along the surface of `shape`, from each of `points` to the nearest of
/// `sources`, all taken to the surface first: the great circle on a sphere, the straight line on a
/// plane. Nothing for other shapes.
std::optional<Eigen::VectorXd> known_distances(const ImplicitShape& shape, Vec3View points,
                                               const Eigen::Matrix3Xd& sources,
                                               const Context& context);

/// One vector a point; zero, and not known, where no closest point of the shape was found or the
/// shape has no normal there.
struct KnownVectors {
  Eigen::Matrix3Xd vectors;
  std::vector<char> known;
};

/// The gradient of f restricted to the surface, at the closest point of each of `points`: the
/// tangential part of f's gradient there.
KnownVectors known_gradients(const ImplicitShape& shape, const Expression& f, Vec3View points,
                             const Context& context);

/// The outward unit normal of the shape at the closest point of each of `points`.
KnownVectors known_normals(const ImplicitShape& shape, Vec3View points, const Context& context);

}  // namespace dsc::cli
