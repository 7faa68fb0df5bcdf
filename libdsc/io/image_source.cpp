// Medical and other images, read by the program dsc-image-reader (io/itk/).
#include "libdsc/io/reader_source.h"
#include "libdsc/io/volume_formats.h"

#include <algorithm>
#include <filesystem>

namespace dsc::detail {

bool is_image(const std::string& path) {
  std::string name = path;
  std::transform(name.begin(), name.end(), name.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  for (const char* ending :
       {".nii", ".nii.gz", ".nrrd", ".nhdr", ".mha", ".mhd", ".tif", ".tiff"}) {
    if (name.ends_with(ending)) return true;
  }
  std::error_code error;
  return std::filesystem::is_directory(path, error);
}

std::unique_ptr<VolumeSource> open_image(const std::string& path, const Context& context) {
  static constexpr ReaderProgram kProgram{"dsc-image-reader", "DSC_IMAGE_READER", "DSC_WITH_ITK"};
  return open_by_reader(kProgram, path, std::nullopt, context);
}

}  // namespace dsc::detail
