// OpenVDB's volumes, read by the program dsc-vdb-reader (io/vdb/).
#include "libdsc/io/reader_source.h"
#include "libdsc/io/volume_formats.h"

namespace dsc::detail {

std::unique_ptr<VolumeSource> open_vdb(const std::string& path,
                                       const std::optional<std::string>& grid,
                                       const Context& context) {
  static constexpr ReaderProgram kProgram{"dsc-vdb-reader", "DSC_VDB_READER", "DSC_WITH_OPENVDB"};
  return open_by_reader(kProgram, path, grid, context);
}

}  // namespace dsc::detail
