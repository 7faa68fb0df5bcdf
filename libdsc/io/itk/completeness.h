/// \file
/// \internal
/// Whether a file holds all the values that it promises. ITK's readers of NIfTI, MetaImage, TIFF
/// and DICOM fill what a truncated file lacks with zeros, or leave out slices, and say nothing.
#pragma once

#include "libdsc/io/itk/dicom_elements.h"

#include <cstdint>
#include <string>

namespace dsc::detail {

/// NIfTI-1, compressed or not. Compressed data is inflated to its checksum. ITK reads as many bytes
/// as the type of the values takes, from the offset in the header: both are checked.
/// \throws ImageError where the file ends early or is damaged, or is NIfTI-2.
void check_nifti(const std::string& path);

/// NRRD: values written as text are refused, whose last number may have lost digits. ITK finds all
/// else. \throws ImageError.
void check_nrrd(const std::string& path);

/// MetaImage with `bytes` bytes of values in all, local or in a file of their own, compressed or
/// not. \throws ImageError likewise, and on text and lists of files, which are not supported.
void check_meta(const std::string& path, std::uint64_t bytes);

/// NRRD with `bytes` bytes of values in all: the file, local or of its own, must be large enough for
/// them in its encoding. ITK finds the rest, but allocates before it looks. Lists of files are not
/// checked. \throws ImageError where it is too small.
void check_nrrd_size(const std::string& path, std::uint64_t bytes);

/// TIFF and BigTIFF: every directory and every strip or tile must lie in the file.
/// \throws ImageError likewise.
void check_tiff(const std::string& path);

/// DICOM of `pixels` pixels: what was found must hold all their bits, unless it is compressed; its
/// fragments are whole then. \throws ImageError likewise.
void check_dicom(const DicomPixels& found, std::uint64_t pixels);

}  // namespace dsc::detail
