/// \file
/// \internal
/// An image as dsc-image-reader sees it: its header first, then its values in pieces.
#pragma once

#include "libdsc/io/image_stream.h"

#include <itkImageIOBase.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

namespace dsc::detail {

/// Why an image cannot be read; its message goes to stderr.
class ImageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// It is larger than memory or than what can be counted.
class ImageTooLarge : public ImageError {
 public:
  using ImageError::ImageError;
};

/// Gets the next bytes of the values.
using TakeBytes = std::function<void(const void* bytes, std::size_t count)>;

class Image {
 public:
  Image() = default;
  Image(const Image&) = delete;
  Image& operator=(const Image&) = delete;
  virtual ~Image() = default;
  virtual ImageHeader header() const = 0;
  virtual void read(const TakeBytes& take) = 0;
};

/// A reader for the file by its extension, its information read. \throws ImageError,
/// itk::ExceptionObject.
itk::ImageIOBase::Pointer open_image_file(const std::string& path);

/// The header of one file: a volume, or a slice as a volume of one. \throws ImageError on several
/// values a voxel, several volumes, a type that is no number.
ImageHeader header_of(itk::ImageIOBase& io);

/// The bytes of the values. \throws ImageError where there are none, ImageTooLarge where they do not
/// fit 64 bits or this machine.
std::size_t value_bytes(const ImageHeader& header);

/// All values of an open file. \throws as ITK.
void read_values(itk::ImageIOBase& io, const ImageHeader& header, const TakeBytes& take);

/// A file, or a folder with the slices of one volume: TIFF files in the natural order of their
/// names, or one DICOM series.
std::unique_ptr<Image> open_image(const std::string& path);
std::unique_ptr<Image> open_folder(const std::string& path);

}  // namespace dsc::detail
