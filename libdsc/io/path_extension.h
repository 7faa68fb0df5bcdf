/// \file
/// By its ending a path says what form its file has.
#pragma once

#include <string>

namespace dsc {

/// The extension with its dot, in lower case: `.vol` of scan.VOL, `.gz` of scan.nii.gz, `.ply` of
/// `ply:-`, standard input or output; empty where there is none, as of .vol, a hidden file.
std::string extension_of(const std::string& path);

}  // namespace dsc
