// One image file by ITK.
#include "libdsc/io/itk/completeness.h"
#include "libdsc/io/itk/image.h"

#include <itkGDCMImageIO.h>
#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>
#include <itkTIFFImageIO.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <vector>

#include <unistd.h>

namespace dsc::detail {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

enum class Format { nifti, nrrd, meta, tiff, dicom };

Format format_of(const std::string& path) {
  const std::string name = lower(path);
  if (name.ends_with(".nii") || name.ends_with(".nii.gz")) return Format::nifti;
  if (name.ends_with(".nrrd") || name.ends_with(".nhdr")) return Format::nrrd;
  if (name.ends_with(".mha") || name.ends_with(".mhd")) return Format::meta;
  if (name.ends_with(".tif") || name.ends_with(".tiff")) return Format::tiff;
  return Format::dicom;  // whose files need no extension
}

itk::ImageIOBase::Pointer reader_for(Format format) {
  switch (format) {
    case Format::nifti:
      return itk::NiftiImageIO::New().GetPointer();
    case Format::nrrd:
      return itk::NrrdImageIO::New().GetPointer();
    case Format::meta:
      return itk::MetaImageIO::New().GetPointer();
    case Format::tiff: {
      const auto tiff = itk::TIFFImageIO::New();
      tiff->SetExpandRGBPalette(false);  // the values are labels, not colours
      return tiff.GetPointer();
    }
    case Format::dicom:
      break;
  }
  return itk::GDCMImageIO::New().GetPointer();
}

/// Throws where the file lacks values and ITK would not say so.
void check_complete(Format format, const std::string& path, const itk::ImageIOBase& io) {
  if (format == Format::meta) {
    check_meta(path, static_cast<std::uint64_t>(io.GetImageSizeInBytes()));
  }
  if (format == Format::nrrd) {
    check_nrrd_size(path, static_cast<std::uint64_t>(io.GetImageSizeInBytes()));
  }
}

/// Sets bytes and kind.
void set_type(const itk::ImageIOBase& io, ImageHeader& header) {
  using Type = itk::IOComponentEnum;
  const Type type = io.GetComponentType();
  header.bytes = static_cast<std::int32_t>(io.GetComponentSize());
  switch (type) {
    case Type::UCHAR:
    case Type::USHORT:
    case Type::UINT:
    case Type::ULONG:
    case Type::ULONGLONG:
      header.kind = 0;
      return;
    case Type::CHAR:
    case Type::SHORT:
    case Type::INT:
    case Type::LONG:
    case Type::LONGLONG:
      header.kind = 1;
      return;
    case Type::FLOAT:
    case Type::DOUBLE:
      header.kind = 2;
      return;
    default:
      throw ImageError("values of type " + itk::ImageIOBase::GetComponentTypeAsString(type) +
                       " are not supported; save integers or floats");
  }
}

class ImageFile final : public Image {
 public:
  explicit ImageFile(const std::string& path)
      : io_(open_image_file(path)), header_(header_of(*io_)) {
    // A TIFF file has a resolution of paper and none between its pages.
    if (dynamic_cast<itk::TIFFImageIO*>(io_.GetPointer()) != nullptr) {
      std::fill_n(header_.spacing, 3, 1.);
    }
  }
  ImageHeader header() const override { return header_; }
  void read(const TakeBytes& take) override { read_values(*io_, header_, take); }

 private:
  itk::ImageIOBase::Pointer io_;
  ImageHeader header_;
};

}  // namespace

itk::ImageIOBase::Pointer open_image_file(const std::string& path) {
  const Format format = format_of(path);
  // These are judged before ITK's readers see them, which abort on some damaged ones and walk round
  // in TIFF directories that run in a circle.
  DicomPixels pixels;
  if (format == Format::dicom) pixels = find_dicom_pixels(path);
  if (format == Format::nifti) check_nifti(path);
  if (format == Format::nrrd) check_nrrd(path);
  if (format == Format::tiff) check_tiff(path);
  const itk::ImageIOBase::Pointer io = reader_for(format);
  if (!io->CanReadFile(path.c_str())) {
    throw ImageError(std::string("this is no file that ") + io->GetNameOfClass() + " reads");
  }
  io->SetFileName(path);
  io->ReadImageInformation();
  check_complete(format, path, *io);
  if (format == Format::dicom) {
    check_dicom(pixels, static_cast<std::uint64_t>(io->GetImageSizeInPixels()));
  }
  return io;
}

ImageHeader header_of(itk::ImageIOBase& io) {
  const unsigned dimensions = io.GetNumberOfDimensions();
  if (io.GetNumberOfComponents() != 1) {
    throw ImageError(std::to_string(io.GetNumberOfComponents()) +
                     " values a voxel (colours, vectors); a volume has one");
  }
  ImageHeader header{};
  std::memcpy(header.start, kImageStart, sizeof kImageStart);
  set_type(io, header);
  for (unsigned axis = 3; axis < dimensions; ++axis) {
    if (io.GetDimensions(axis) > 1) {
      throw ImageError("the image holds " + std::to_string(io.GetDimensions(axis)) +
                       " volumes; extract one of them to a file of its own");
    }
  }
  for (unsigned axis = 0; axis < 3; ++axis) {
    const bool there = axis < dimensions;
    header.size[axis] = there ? static_cast<std::int64_t>(io.GetDimensions(axis)) : 1;
    header.spacing[axis] = there ? io.GetSpacing(axis) : 1.;
    header.origin[axis] = there ? io.GetOrigin(axis) : 0.;
    const std::vector<double> cosines = there ? io.GetDirection(axis) : std::vector<double>{};
    for (unsigned row = 0; row < 3; ++row) {
      header.direction[3 * row + axis] =
          row < cosines.size() ? cosines[row] : (row == axis ? 1. : 0.);
    }
  }
  return header;
}

std::size_t value_bytes(const ImageHeader& header) {
  const auto memory = static_cast<std::int64_t>(::sysconf(_SC_PHYS_PAGES)) *
                      static_cast<std::int64_t>(::sysconf(_SC_PAGE_SIZE));
  std::int64_t bytes = header.bytes;
  for (const std::int64_t size : header.size) {
    if (size <= 0) throw ImageError("the image is empty");
    if (size > memory / bytes)
      throw ImageTooLarge("the image is larger than this machine's memory");
    bytes *= size;
  }
  return static_cast<std::size_t>(bytes);
}

void read_values(itk::ImageIOBase& io, const ImageHeader& header, const TakeBytes& take) {
  const std::size_t all = value_bytes(header);
  const auto slices = static_cast<std::size_t>(header.size[2]);
  // ITK reads pieces of what is not compressed; all at once else.
  const std::size_t piece =
      io.CanStreamRead() ? std::max<std::size_t>(1, (4u << 20) / (all / slices)) : slices;
  const unsigned dimensions = io.GetNumberOfDimensions();
  std::vector<char> buffer(all / slices * std::min(piece, slices));
  for (std::size_t first = 0; first < slices; first += piece) {
    const std::size_t count = std::min(piece, slices - first);
    itk::ImageIORegion region(dimensions);
    for (unsigned axis = 0; axis < dimensions; ++axis) {
      region.SetIndex(axis, axis == 2 ? static_cast<itk::IndexValueType>(first) : 0);
      region.SetSize(axis, axis == 2 ? count : io.GetDimensions(axis));
    }
    io.SetIORegion(region);
    io.Read(buffer.data());
    take(buffer.data(), all / slices * count);
  }
}

std::unique_ptr<Image> open_image(const std::string& path) {
  if (std::filesystem::is_directory(path)) return open_folder(path);
  return std::make_unique<ImageFile>(path);
}

}  // namespace dsc::detail
