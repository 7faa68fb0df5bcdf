/// \file
/// Volumes to `.vol`, `.longvol`, `.npy` and `.vti`, chosen by the extension (formats:
/// volume_source.h).
///
/// Files appear whole or not at all (AtomicFile). A spacing other than 1 is written to `.vol` and
/// `.longvol` as the keys Spacing-X, -Y, -Z, which other readers ignore; `.npy` has no place for
/// it, nor any of the three for the origin: those are not written. `.vti` has all of them, and the
/// turn of the world.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/io/volume_source.h"
#include "libdsc/voxels/binary_volume.h"

#include <string>

namespace dsc {

/// How a volume is written.
struct VolumeWriteOptions {
  bool compress = true;  ///< .vol and .longvol: version 3 (zlib) or 2 (raw); .vti: zlib or raw
  RigidMap world = {};   ///< from positions of the grid to the world; .vti alone keeps it
};

/// Voxels inside become 1, the others 0; .npy gets the type bool, .vti UInt8. \throws UsageError on
/// another extension, OutputError where the file cannot be written.
void write_volume(const std::string& path, const BinaryVolume& volume,
                  const VolumeWriteOptions& options = {}, const Context& context = {});

/// values[x + X (y + Y z)]. .npy and .vti keep the type; .vol wants whole values in [0, 255],
/// .longvol whole values that are not negative. \throws InputError on others, naming the first
/// voxel, or where the number of values is not the grid's.
void write_volume(const std::string& path, const Grid& grid, const VoxelValues& values,
                  const VolumeWriteOptions& options = {}, const Context& context = {});

}  // namespace dsc
