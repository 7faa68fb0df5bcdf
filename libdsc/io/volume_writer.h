/// \file
/// Volumes to `.vol`, `.longvol`, `.npy` and `.vti`, chosen by the extension (formats:
/// volume_source.h).
///
/// Files appear whole or not at all (AtomicFile); `vol:-` and so on is standard output. A spacing
/// other than 1 is written to `.vol` and `.longvol` as the keys Spacing-X, -Y, -Z, which other
/// readers ignore; `.npy` has no room for it, nor any of the three for the place in the world, the
/// origin and the turn: write_volume() returns the names of what it left out, "the spacing" and
/// "the place in the world". `.vti` keeps all.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/io/volume_source.h"
#include "libdsc/voxels/binary_volume.h"
#include "libdsc/voxels/label_volume.h"

#include <string>
#include <vector>

namespace dsc {

/// How a volume is written.
struct VolumeWriteOptions {
  bool compress = true;  ///< .vol and .longvol: version 3 (zlib) or 2 (raw); .vti: zlib or raw
  RigidMap world = {};   ///< from positions of the grid to the world; .vti alone keeps it
};

/// The endings that write_volume() knows, for messages and help.
std::string written_volume_endings();

/// Whether the ending of `path` is one of them.
bool is_written_volume_path(const std::string& path);

/// Whether that form has room for a spacing.
bool keeps_spacing(const std::string& path);

/// Refuses a path that write_volume() could not serve, before anything is computed. \throws
/// UsageError where the ending is unknown, naming the ones known; OutputError as check_writable().
void check_volume_path(const std::string& path);

/// Voxels inside become 1, the others 0; .npy gets the type bool, .vti UInt8. Compressed slices of
/// .vti wait in memory until the last is made. \return what the form has no room for (see above).
/// \throws UsageError on another extension, InputError where the grid has no voxel, OutputError
/// where the file cannot be written, LimitError, Cancelled.
std::vector<std::string> write_volume(const std::string& path, const BinaryVolume& volume,
                                      const VolumeWriteOptions& options = {},
                                      const Context& context = {});

/// Every label; .npy and .vti keep their width, unsigned, .vol wants labels up to 255. \throws
/// likewise, and InputError on others, naming the first voxel.
std::vector<std::string> write_volume(const std::string& path, const LabelVolume& volume,
                                      const VolumeWriteOptions& options = {},
                                      const Context& context = {});

/// values[x + X (y + Y z)]. .npy and .vti keep the type; .vol wants whole values in [0, 255],
/// .longvol whole values that are not negative. \throws InputError on others, naming the first
/// voxel, or where the number of values is not the grid's.
std::vector<std::string> write_volume(const std::string& path, const Grid& grid,
                                      const VoxelValues& values,
                                      const VolumeWriteOptions& options = {},
                                      const Context& context = {});

}  // namespace dsc
