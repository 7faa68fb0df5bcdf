/// \file
/// The elements of a DICOM file, walked before ITK reads them: its reader GDCM aborts on some files
/// that end early, and makes zeros of missing values on others.
#pragma once

#include <cstdint>
#include <string>

namespace dsc::detail {

/// What the walk finds on its way.
struct DicomPixels {
  std::uint64_t bytes = 0;  ///< of the values; of all fragments where compressed
  std::uint64_t bits = 0;   ///< that a value takes (Bits Allocated); 0 where the file does not say
  bool compressed = false;
};

/// Walks to the end of the pixel data of a file in any transfer syntax. Elements after it are not
/// looked at. \throws ImageError where the file ends before, an element is damaged, or there is no
/// pixel data.
DicomPixels find_dicom_pixels(const std::string& path);

/// Whether a file has the preamble and the mark of DICOM.
bool has_dicom_mark(const std::string& path);

}  // namespace dsc::detail
