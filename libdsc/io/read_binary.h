/// \file
/// Which voxels of a file are inside, and the binary volume that they make.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/io/volume_source.h"
#include "libdsc/voxels/binary_volume.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dsc {

/// The values that are inside: those in a closed interval or those of a list, not both; by default
/// every value but 0, of a level set those below 0, of a fog volume those above 0. NaN is never
/// inside.
struct VoxelSelection {
  /// Closed: both ends are inside.
  struct Interval {
    double low;   ///< may be -infinity
    double high;  ///< may be +infinity
  };
  std::optional<Interval> threshold;  ///< none by default
  std::vector<std::int64_t> labels;   ///< values from 2^63 on can be chosen by threshold only

  /// \throws UsageError where both are given, or the interval is empty or NaN.
  void check() const;
  /// The same, and where neither is given, the interval that the class of the values implies.
  VoxelSelection completed(VolumeClass volume_class) const;
};

/// Reads `source` in slabs; memory is one bit a voxel and one slab. Interval and labels are
/// compared exactly. \throws as VolumeSource::read and BinaryVolume.
BinaryVolume read_binary(VolumeSource& source, const VoxelSelection& selection = {},
                         const Context& context = {});

/// open_volume, then read_binary.
BinaryVolume read_binary(const std::string& path, const VoxelSelection& selection = {},
                         const Context& context = {});

}  // namespace dsc
