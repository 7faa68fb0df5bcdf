/// \file
/// \internal
/// What stands before the values in each form of volume that is written.
#pragma once

#include "libdsc/voxels/grid.h"
#include "libdsc/voxels/rigid_map.h"

#include <string>

namespace dsc::detail {

/// Lines `Key: value`, for bytes (.vol) or words of eight (.longvol), deflated or not.
std::string vol_header(const Grid& grid, bool longvol, bool compress);
/// `descr` is numpy's name of the type.
std::string npy_header(const Grid& grid, const std::string& descr);
/// The XML before the values, which are appended raw; voxels are the points of the image.
std::string vti_header(const Grid& grid, const RigidMap& world, const std::string& type,
                       bool compress);

}  // namespace dsc::detail
