/// \file
/// \internal
/// The name `FORMAT:-`, as in `vol:-`, stands for standard input or output, of what a file with the
/// ending `.FORMAT` holds; `./vol:-` is a file.
#pragma once

#include <string>

namespace dsc::detail {

/// Whether `path` is such a name.
inline bool is_standard_stream(const std::string& path) {
  return path.size() > 2 && path.ends_with(":-") && path.find('/') == std::string::npos;
}

}  // namespace dsc::detail
