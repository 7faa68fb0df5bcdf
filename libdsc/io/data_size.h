/// \file
/// \internal
/// How many bytes a header promises.
#pragma once

#include "libdsc/io/input_file.h"
#include "libdsc/voxels/grid.h"

namespace dsc::detail {

/// The bytes of a volume of `grid` with values of `value_bytes`, whose sizes stand at byte `at` of
/// `file`. \throws LimitError naming the file, the byte and the sizes where 64 bits cannot count
/// them, or where the machine's memory could not hold one bit a voxel, the least that any use
/// takes.
Index data_bytes(const InputFile& file, Index at, const Grid& grid, int value_bytes);

}  // namespace dsc::detail
