/// \file
/// \internal
/// Sums over the voxels of a row, run by run.
#pragma once

#include "libdsc/normals/row_sums.h"
#include "libdsc/voxels/binary_volume.h"

namespace dsc {

/// The voxels x in [low, high] of row (y, z), all within the grid, relative to doubled cx.
RowSums scan_row(const BinaryVolume& volume, Index low, Index high, Index y, Index z, Index cx);

}  // namespace dsc
