/// \file
/// Gauss digitization of an implicit shape: the lattice points p = (hx i, hy j, hz k), i, j, k
/// integers, in bounds() with f(p) < 0, strictly.
///
/// The lattice contains the origin of the world whatever the bounds, so which voxels are inside
/// does not depend on the box. The grid covers the lattice points of bounds() (up to a relative
/// 1e-9 of a gridstep on its border) with a margin of one empty voxel where the shape is closed,
/// and without margin where bounds() cuts it, so that the cut lies on the border of the grid. A
/// shape thinner than the gridstep may give an empty volume.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/voxels/binary_volume.h"
#include "libdsc/voxels/implicit_shape.h"

namespace dsc {

/// The grid that digitize() fills. \throws UsageError where a spacing is not positive and finite,
/// LimitError where an axis would have more than 2^31 voxels or memory could not hold one bit for
/// each.
Grid digitization_grid(const ImplicitShape& shape, const Vec3& spacing);

/// Parallel over z; the same voxels for any thread count. \throws as digitization_grid, LimitError
/// where memory does not suffice, InputError where an expression cannot be evaluated at a voxel.
BinaryVolume digitize(const ImplicitShape& shape, const Vec3& spacing, const Context& context = {});

}  // namespace dsc
