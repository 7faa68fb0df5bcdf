/// \file
/// Exact curvatures and Laplacians on shapes, to measure errors against.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/voxels/expression.h"
#include "libdsc/voxels/implicit_curvature.h"

#include <optional>
#include <vector>

namespace dsc::cli {

/// implicit_curvature() at each of `points`, which lie on the surface.
std::vector<std::optional<ImplicitCurvature>> known_curvatures(const ImplicitShape& shape,
                                                               Vec3View points,
                                                               const Context& context);

/// The Laplace-Beltrami operator of f restricted to the surface, tr Hess f - n·Hess f n - 2 H
/// n·grad f, at each of `points`, which lie on the surface; nothing where the shape has no normal
/// there. f's derivatives are differences of fourth order (expression_shape.h).
std::vector<std::optional<double>> known_laplacians(const ImplicitShape& shape, const Expression& f,
                                                    Vec3View points, const Context& context);

}  // namespace dsc::cli
