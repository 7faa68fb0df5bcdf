/// \file
/// \internal
/// Whether a file holds all the values that it promises. ITK's readers of NIfTI, MetaImage, TIFF
/// and DICOM fill what a truncated file lacks with zeros, or leave out slices, and say nothing.
#pragma once

#include <cstdint>
#include <string>

namespace dsc::detail {

/// NIfTI-1 and -2, compressed or not. Compressed data is inflated to its checksum.
/// \throws ImageError where the file ends early or is damaged.
void check_nifti(const std::string& path);

/// MetaImage with `bytes` bytes of values in all, local or in a file of their own, compressed or
/// not. \throws ImageError likewise, and on text and lists of files, which are not supported.
void check_meta(const std::string& path, std::uint64_t bytes);

/// NRRD with `bytes` bytes of values in all: the file, local or of its own, must be large enough for
/// them in its encoding. ITK finds the rest, but allocates before it looks. Lists of files are not
/// checked. \throws ImageError where it is too small.
void check_nrrd(const std::string& path, std::uint64_t bytes);

/// TIFF and BigTIFF: every directory and every strip or tile must lie in the file.
/// \throws ImageError likewise.
void check_tiff(const std::string& path);

/// DICOM of `pixels` pixels: its pixel data must end in the file. Only little-endian files that are
/// not deflated as a whole are checked. \throws ImageError likewise.
void check_dicom(const std::string& path, std::uint64_t pixels);

}  // namespace dsc::detail
