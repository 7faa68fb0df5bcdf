/// \file
/// Numbers in the words of a command line.
#pragma once

#include "libdsc/base/types.h"
#include "libdsc/voxels/label_volume.h"

#include <string>
#include <string_view>
#include <vector>

namespace dsc::cli {

/// The finite numbers of a comma-separated list. \throws UsageError naming `option`.
std::vector<double> parse_numbers(std::string_view text, const std::string& option);

/// Three of them. \throws UsageError naming `option`.
Vec3 parse_point(std::string_view text, const std::string& option);

/// One positive number for all axes, or three. \throws UsageError naming `option`.
Vec3 parse_spacing(std::string_view text, const std::string& option);

/// Three positive whole numbers. \throws UsageError naming `option`.
Index3 parse_size(std::string_view text, const std::string& option);

/// Bytes: a positive number, whole or not, and K, M or G (powers of 1024) after it or nothing.
/// \throws UsageError naming `option`.
Index parse_bytes(std::string_view text, const std::string& option);

/// Two different labels. \throws UsageError naming `option`.
LabelPair parse_labels(std::string_view text, const std::string& option);

}  // namespace dsc::cli
