#include "libdsc/io/volume_source.h"

#include "libdsc/base/checked.h"
#include "libdsc/base/error.h"
#include "libdsc/io/input_file.h"
#include "libdsc/io/path_extension.h"
#include "libdsc/io/volume_formats.h"

#include <algorithm>
#include <vector>

namespace dsc {
namespace detail {
namespace {

/// Reverses the bytes of every value in place.
template <class T>
void swap_bytes(T* values, Index count) {
  for (Index i = 0; i < count; ++i) {
    auto* bytes = reinterpret_cast<unsigned char*>(values + i);
    std::reverse(bytes, bytes + sizeof(T));
  }
}

template <class T>
void stream_typed(Index slices, Index per_slice, bool swap, const ByteReader& next,
                  const std::function<void(const Slab&)>& take, const Context& context) {
  constexpr Index kSlabBytes = Index{4} << 20;
  const Index bytes_per_slice = checked_product(per_slice, sizeof(T), "bytes of a slice");
  const Index per_slab =
      std::clamp<Index>(kSlabBytes / std::max<Index>(1, bytes_per_slice), 1, slices);
  // Slabs of several slices are small; a single slice may be of any size.
  context.need("read", checked_product(bytes_per_slice, per_slab, "bytes of a slab"));
  std::vector<T> buffer(static_cast<std::size_t>(per_slice * per_slab));
  for (Index first = 0; first < slices; first += per_slab) {
    context.check();
    const Index last = std::min(slices, first + per_slab);
    const Index count = (last - first) * per_slice;
    next(buffer.data(), count * static_cast<Index>(sizeof(T)));
    if (swap) swap_bytes(buffer.data(), count);
    take(Slab{first, last, std::span<const T>(buffer.data(), static_cast<std::size_t>(count))});
    context.advance(last - first);
  }
}

}  // namespace

void stream_slabs(Index slices, Index per_slice, const ValueType& type, const ByteReader& next,
                  const std::function<void(const Slab&)>& take, const Context& context) {
  if (type.is_float) {
    return type.bytes == 4
               ? stream_typed<float>(slices, per_slice, type.swap, next, take, context)
               : stream_typed<double>(slices, per_slice, type.swap, next, take, context);
  }
  const auto stream = [&](auto unsigned_zero, auto signed_zero) {
    if (type.is_signed) {
      stream_typed<decltype(signed_zero)>(slices, per_slice, type.swap, next, take, context);
    } else {
      stream_typed<decltype(unsigned_zero)>(slices, per_slice, type.swap, next, take, context);
    }
  };
  switch (type.bytes) {
    case 1:
      return stream(std::uint8_t{}, std::int8_t{});
    case 2:
      return stream(std::uint16_t{}, std::int16_t{});
    case 4:
      return stream(std::uint32_t{}, std::int32_t{});
    default:
      return stream(std::uint64_t{}, std::int64_t{});
  }
}

}  // namespace detail

std::string volume_endings() {
  return ".vol, .longvol, .npy, .vox, .vti, .vdb, .nii, .nii.gz, .nrrd, .nhdr, .mha, .mhd, .tif, "
         ".tiff, "
         "a "
         "folder of TIFF or DICOM slices";
}

ValueType value_type(const std::string& name) {
  const std::size_t digits = name.find_first_of("123456789");
  const std::string bits = digits == 1 ? name.substr(1) : "";
  ValueType type;
  type.bytes = bits == "8" ? 1 : bits == "16" ? 2 : bits == "32" ? 4 : bits == "64" ? 8 : 0;
  type.is_signed = name[0] == 'i';
  type.is_float = name[0] == 'f';
  const bool known = type.is_float ? type.bytes >= 4 : type.is_signed || name[0] == 'u';
  if (type.bytes == 0 || !known) {
    throw UsageError("'" + name +
                     "' is no type of values; there are u8, i8, u16, i16, u32, i32, u64, i64, f32 "
                     "and f64");
  }
  return type;
}

std::unique_ptr<VolumeSource> open_volume(const std::string& path, const VolumeOptions& options,
                                          const Context& context) {
  const std::string extension = extension_of(path);
  if (extension == ".vdb") return detail::open_vdb(path, options.grid, context);
  if (options.grid) {
    throw UsageError("'" + path + "': the grid '" + detail::printable(*options.grid) +
                     "' was asked for, and only .vdb files hold grids by name");
  }
  if (extension == ".vol") return detail::open_vol(InputFile(path, context), false);
  if (extension == ".longvol") return detail::open_vol(InputFile(path, context), true);
  if (extension == ".npy") return detail::open_npy(InputFile(path, context));
  if (extension == ".vox") return detail::open_vox(InputFile(path, context));
  if (extension == ".vti") return detail::open_vti(InputFile(path, context));
  if (extension == ".raw") {
    throw UsageError("'" + path +
                     "': a raw file does not say how its values lie; give its size and type");
  }
  if (detail::is_image(path)) return detail::open_image(path, context);
  throw UsageError("'" + path + "': the extension '" + extension + "' is no volume format; " +
                   volume_endings() + " are read, and raw files with size and type");
}

std::unique_ptr<VolumeSource> open_volume(const std::string& path, const Context& context) {
  return open_volume(path, VolumeOptions{}, context);
}

}  // namespace dsc
