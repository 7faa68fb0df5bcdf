/// \file
/// \internal
/// A grid of an OpenVDB file as a box of voxels.
///
/// The box is that of the active voxels, in a level set with the inactive ones of its interior;
/// what is outside it has the background value. In the box every voxel has its value, be it of a
/// voxel, a tile or the background, active or not; only of mask grids the active ones are 1.
#pragma once

#include "libdsc/io/reader_program.h"

#include <exception>
#include <memory>
#include <string>

namespace dsc::detail {

/// The grid that request.part names, or the only one whose values are numbers.
/// \throws ImageError where there is none or more than one, where it is empty, or where its voxels
/// are no boxes in the world; ImageTooLarge where even a bit a voxel would not fit in memory;
/// OpenVDB's exceptions, and those of streams, on damaged files.
std::unique_ptr<Image> open_vdb_image(const ImageRequest& request);

/// What an exception of OpenVDB, of streams or of the standard library means here.
std::string vdb_message(const std::exception& error);

}  // namespace dsc::detail
