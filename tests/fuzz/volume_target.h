/// \file
/// What every reader of volumes has to keep.
#pragma once

#include "libdsc/io/volume_source.h"

#include <functional>
#include <memory>
#include <string>

namespace dsc::fuzz {

using OpenVolume = std::function<std::unique_ptr<VolumeSource>()>;

/// Reads the volume that `open` opens anew each time, compares labels and bits with its values,
/// writes it as `ending` (empty: not) and reads that with `reopen`. Grids above 4096 voxels are
/// opened only: files of a few bytes may stand for them, and they take long.
/// \throws Broken; dsc::Error where the bytes are refused.
void check_volume_reader(
    const OpenVolume& open, const std::string& ending,
    const std::function<std::unique_ptr<VolumeSource>(std::string_view bytes)>& reopen);

}  // namespace dsc::fuzz
