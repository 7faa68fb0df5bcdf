/// \file
/// \internal
/// What the readers of the formats share.
#pragma once

#include "libdsc/io/input_file.h"
#include "libdsc/io/volume_source.h"

#include <memory>
#include <optional>
#include <string>

namespace dsc::detail {

std::unique_ptr<VolumeSource> open_vol(InputFile file, bool longvol);
std::unique_ptr<VolumeSource> open_npy(InputFile file);
std::unique_ptr<VolumeSource> open_vox(InputFile file);
std::unique_ptr<VolumeSource> open_vti(InputFile file);
std::unique_ptr<VolumeSource> open_raw(InputFile file, const RawLayout& layout);

/// Whether dsc-image-reader is to read it: by its extension, or because it is a folder.
bool is_image(const std::string& path);
std::unique_ptr<VolumeSource> open_image(const std::string& path, const Context& context);

/// By dsc-vdb-reader; `grid` as VolumeOptions has it.
std::unique_ptr<VolumeSource> open_vdb(const std::string& path,
                                       const std::optional<std::string>& grid,
                                       const Context& context);

/// Delivers the next bytes of the values.
using ByteReader = std::function<void(void* to, Index bytes)>;

/// Hands `slices` slices of `per_slice` values each to `take`, in slabs.
void stream_slabs(Index slices, Index per_slice, const ValueType& type, const ByteReader& next,
                  const std::function<void(const Slab&)>& take, const Context& context);

}  // namespace dsc::detail
