/// \file
/// \internal
/// Images by ITK.
#pragma once

#include "libdsc/io/reader_program.h"

#include <itkImageIOBase.h>

#include <cstddef>
#include <memory>
#include <string>

namespace dsc::detail {

/// A reader for the file by its extension, its information read. \throws ImageError,
/// itk::ExceptionObject.
itk::ImageIOBase::Pointer open_image_file(const std::string& path);

/// The header of one file: a volume, or a slice as a volume of one. \throws ImageError on several
/// values a voxel, several volumes, a type that is no number.
ImageHeader header_of(itk::ImageIOBase& io);

/// The bytes of the values. \throws ImageError where there are none, ImageTooLarge where they do
/// not fit 64 bits or this machine.
std::size_t value_bytes(const ImageHeader& header);

/// All values of an open file. \throws as ITK.
void read_values(itk::ImageIOBase& io, const ImageHeader& header, const TakeBytes& take);

/// A file, or a folder with the slices of one volume: TIFF files in the natural order of their
/// names, or one DICOM series.
std::unique_ptr<Image> open_image(const std::string& path);
std::unique_ptr<Image> open_folder(const std::string& path);

}  // namespace dsc::detail
