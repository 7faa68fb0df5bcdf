/// \file
/// Exact normals, where the shape behind the digital surface is known: grad f / |grad f| at the
/// point of {f = 0} closest to the surfel's centre.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/normals/normal_field.h"
#include "libdsc/surface/surfel.h"
#include "libdsc/voxels/implicit_shape.h"

#include <span>

namespace dsc {

/// One normal a surfel. A surfel keeps its own normal, and is counted in `fallbacks`, where the
/// projection did not converge or the gradient vanishes. u is the shape's: on a coarse grid it may
/// point to a surfel's inner side. \throws InputError where an expression cannot be evaluated.
NormalField analytic_normals(const ImplicitShape& shape, const Grid& grid,
                             std::span<const Surfel> surfels, const Context& context = {});

}  // namespace dsc
