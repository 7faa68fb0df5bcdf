/// \file
/// \internal
/// What goes through the pipe from a program that reads volumes (dsc-image-reader, dsc-vdb-reader)
/// to the process that started it: an ImageHeader, the name of the part of the file that it is, the
/// values (x fastest, then y, then z), kImageEnd. Both run on one machine, so everything is as it
/// lies in memory.
#pragma once

#include <cstdint>
#include <type_traits>

namespace dsc::detail {

inline constexpr char kImageStart[8] = {'d', 's', 'c', 'i', 'm', 'g', '0', '2'};
inline constexpr char kImageEnd[8] = {'d', 's', 'c', 'i', 'm', 'g', 'e', 'n'};
inline constexpr std::int32_t kLongestName = 1000;

struct ImageHeader {
  char start[8];              ///< kImageStart
  std::int64_t size[3];       ///< voxels
  std::int32_t bytes;         ///< of a value: 1, 2, 4, 8
  std::int32_t kind;          ///< 0 unsigned, 1 signed, 2 float
  double spacing[3];          ///< world units; of images millimetres
  double origin[3];           ///< centre of the first voxel in the world; of images LPS
  double direction[9];        ///< row by row; columns are the axes of the volume in the world
  std::int32_t volume_class;  ///< a VolumeClass: 0 values, 1 level_set, 2 fog_volume
  std::int32_t name_bytes;    ///< of the part's name, which follows; 0 where there are no parts
};
static_assert(std::is_trivially_copyable_v<ImageHeader>);

}  // namespace dsc::detail
