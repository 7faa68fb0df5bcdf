#include "libdsc/io/data_size.h"

#include "libdsc/base/checked.h"

namespace dsc::detail {

Index data_bytes(const InputFile& file, Index at, const Grid& grid, int value_bytes) {
  try {
    const Index voxels = grid.voxels();
    check_allocation(voxels / 8, "one bit a voxel");
    return checked_product(voxels, value_bytes, "bytes");
  } catch (const LimitError& e) {
    throw LimitError("'" + file.path() + "', byte " + std::to_string(at) + ": " + grid.text() +
                     " are too large: " + e.what());
  }
}

}  // namespace dsc::detail
