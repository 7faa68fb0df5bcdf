/// \file
/// The label volume of a file.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/io/volume_source.h"
#include "libdsc/voxels/label_volume.h"

#include <string>

namespace dsc {

/// Every value as a label, 0 being the outside, in as many bytes as the file has a value, 4 at
/// most. \throws InputError where a value is not a whole number from 0 to 2^32 - 1, naming the
/// first such voxel; otherwise as VolumeSource::read and LabelVolume.
LabelVolume read_labels(VolumeSource& source, const Context& context = {});

/// open_volume, then read_labels.
LabelVolume read_labels(const std::string& path, const Context& context = {});

}  // namespace dsc
