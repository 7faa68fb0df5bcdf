#include "libdsc/io/path_extension.h"

#include "libdsc/io/standard_stream.h"

#include <algorithm>
#include <filesystem>

namespace dsc {

std::string extension_of(const std::string& path) {
  std::string extension = detail::is_standard_stream(path)
                              ? "." + path.substr(0, path.size() - 2)
                              : std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return extension;
}

}  // namespace dsc
