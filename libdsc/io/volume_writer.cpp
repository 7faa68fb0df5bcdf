#include "libdsc/io/volume_writer.h"

#include "libdsc/base/error.h"
#include "libdsc/base/parallel.h"
#include "libdsc/io/atomic_file.h"
#include "libdsc/io/path_extension.h"
#include "libdsc/io/volume_headers.h"

#include <zlib.h>

#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace dsc {
namespace {

using detail::npy_header;
using detail::vol_header;
using detail::vti_header;

enum class Format { kVol, kLongvol, kNpy, kVti };

std::optional<Format> known_format(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == ".vol") return Format::kVol;
  if (extension == ".longvol") return Format::kLongvol;
  if (extension == ".npy") return Format::kNpy;
  if (extension == ".vti") return Format::kVti;
  return std::nullopt;
}

Format format_of(const std::string& path) {
  if (const auto format = known_format(path)) return *format;
  throw UsageError("'" + path + "': the extension '" + extension_of(path) +
                   "' is no volume format; " + written_volume_endings() + " are written");
}

/// What the form has no room for.
std::vector<std::string> left_out(Format format, const Grid& grid, const RigidMap& world) {
  std::vector<std::string> names;
  if (format == Format::kVti) return names;
  if (format == Format::kNpy && grid.spacing != Vec3::Ones()) names.emplace_back("the spacing");
  if (!world.is_identity() || grid.origin != Vec3::Zero()) {
    names.emplace_back("the place in the world");
  }
  return names;
}

template <class T>
std::string vti_type() {
  return std::string(std::is_floating_point_v<T> ? "Float"
                     : std::is_signed_v<T>       ? "Int"
                                                 : "UInt") +
         std::to_string(8 * sizeof(T));
}

/// Bytes to a file, through zlib or not.
class Sink {
 public:
  Sink(AtomicFile& file, bool compress) : file_(file), compress_(compress) {
    if (!compress) return;
    out_.resize(std::size_t{1} << 18);
    if (deflateInit(&stream_, Z_DEFAULT_COMPRESSION) != Z_OK) {
      throw LimitError("zlib: no memory to deflate");
    }
  }
  Sink(const Sink&) = delete;
  Sink& operator=(const Sink&) = delete;
  ~Sink() {
    if (compress_) (void)deflateEnd(&stream_);
  }

  void write(const void* data, std::size_t bytes) {
    if (!compress_) return file_.write(data, bytes);
    constexpr std::size_t kChunk = std::size_t{1} << 30;  // zlib counts in 32 bits
    const auto* next = static_cast<const Bytef*>(data);
    while (bytes > 0) {
      const std::size_t chunk = std::min(bytes, kChunk);
      stream_.next_in = const_cast<Bytef*>(next);
      stream_.avail_in = static_cast<uInt>(chunk);
      run(Z_NO_FLUSH);
      next += chunk;
      bytes -= chunk;
    }
  }
  void finish() {
    if (compress_) run(Z_FINISH);
  }

 private:
  void run(int flush) {
    do {
      stream_.next_out = out_.data();
      stream_.avail_out = static_cast<uInt>(out_.size());
      (void)deflate(&stream_, flush);
      file_.write(out_.data(), out_.size() - stream_.avail_out);
    } while (stream_.avail_out == 0);
  }

  AtomicFile& file_;
  bool compress_;
  std::vector<Bytef> out_;
  z_stream stream_{};
};

/// Writes header and slices; fill(z, values) gives the X Y values of slice z as type T.
template <class T, class Fill>
void write_slices(const std::string& path, const Grid& grid, const std::string& header,
                  bool compress, const Fill& fill, const Context& context) {
  AtomicFile file(path);
  file.write(header);
  Sink sink(file, compress);
  const Index slice = checked_product(grid.size[0], grid.size[1], "voxels of a slice");
  context.need("write", checked_product(slice, sizeof(T), "bytes of a slice"));
  std::vector<T> values(static_cast<std::size_t>(slice));
  context.begin("write", grid.size[2]);
  for (Index z = 0; z < grid.size[2]; ++z) {
    context.check();
    fill(z, values.data());
    sink.write(values.data(), values.size() * sizeof(T));
    context.advance(1);
  }
  sink.finish();
  file.commit();
}

/// A .vti file: a block of values a slice, compressed in parallel where that is wanted. The sizes
/// of all blocks come before the first, so compressed ones wait in memory.
template <class T, class Fill>
void write_vti(const std::string& path, const Grid& grid, const VolumeWriteOptions& options,
               const Fill& fill, const Context& context) {
  AtomicFile file(path);
  file.write(vti_header(grid, options.world, vti_type<T>(), options.compress));
  const Index slice = checked_product(grid.size[0], grid.size[1], "voxels of a slice");
  const auto bytes =
      static_cast<std::uint64_t>(checked_product(slice, sizeof(T), "bytes of a slice"));
  const auto slices = static_cast<std::uint64_t>(grid.size[2]);
  const auto word = [&](std::uint64_t value) { file.write(&value, sizeof value); };
  context.begin("write", grid.size[2]);
  if (options.compress) {
    std::vector<std::vector<Bytef>> blocks(slices);
    parallel_for(context, grid.size[2], 1, [&](Index z, Index) {
      uLongf size = compressBound(bytes);
      context.need("write", static_cast<Index>(bytes + size));  // beside the blocks made so far
      std::vector<T> values(static_cast<std::size_t>(slice));
      fill(z, values.data());
      std::vector<Bytef>& block = blocks[static_cast<std::size_t>(z)];
      block.resize(size);
      if (compress(block.data(), &size, reinterpret_cast<const Bytef*>(values.data()), bytes) !=
          Z_OK) {
        throw LimitError("'" + path + "': zlib has no memory to compress");
      }
      block.resize(size);
      block.shrink_to_fit();
      context.advance(1);
    });
    for (const std::uint64_t value : {slices, bytes, std::uint64_t{0}}) word(value);
    for (const auto& block : blocks) word(block.size());
    for (const auto& block : blocks) file.write(block.data(), block.size());
  } else {
    word(slices * bytes);
    context.need("write", static_cast<Index>(bytes));
    std::vector<T> values(static_cast<std::size_t>(slice));
    for (Index z = 0; z < grid.size[2]; ++z) {
      context.check();
      fill(z, values.data());
      file.write(values.data(), bytes);
      context.advance(1);
    }
  }
  file.write("\n</AppendedData>\n</VTKFile>\n");
  file.commit();
}

void check_grid(const Grid& grid, const std::string& path) {
  for (const Index size : grid.size) {
    if (size <= 0) throw InputError("'" + path + "': an empty volume cannot be written");
  }
}

/// "<i4" and so on, of this machine's byte order.
template <class T>
std::string descr_of() {
  const char order = sizeof(T) == 1 ? '|' : std::endian::native == std::endian::little ? '<' : '>';
  return {order,
          std::is_floating_point_v<T> ? 'f'
          : std::is_signed_v<T>       ? 'i'
                                      : 'u',
          static_cast<char>('0' + sizeof(T))};
}

static_assert(std::endian::native == std::endian::little,
              ".longvol words are written as they are in memory");

/// `value` as a T. \throws InputError where it does not fit.
template <class T, class From>
T fitting(From value, Index at, const Grid& grid, const std::string& path) {
  bool fits = std::is_same_v<T, From>;
  if constexpr (std::is_floating_point_v<From> && !std::is_floating_point_v<T>) {
    // The largest T may be no double; the number after it is a power of two.
    fits = value >= 0 && value < std::ldexp(1., std::numeric_limits<T>::digits) &&
           value == std::floor(value);
  } else if constexpr (!std::is_same_v<T, From>) {
    fits = std::in_range<T>(value);
  }
  if (!fits) {
    const Index x = at % grid.size[0];
    const Index y = at / grid.size[0] % grid.size[1];
    const Index z = at / grid.size[0] / grid.size[1];
    throw InputError("'" + path + "': the value " + std::to_string(value) + " of voxel (" +
                     std::to_string(x) + ", " + std::to_string(y) + ", " + std::to_string(z) +
                     ") does not fit the format; write .npy");
  }
  return static_cast<T>(value);
}

/// Writes what fill(z, to) puts to the X Y values of slice z; the forms that keep a type keep
/// `Kept`, numpy's name of which is `descr`.
template <class Kept, class Fill>
std::vector<std::string> write_filled(const std::string& path, const Grid& grid,
                                      const std::string& descr, const Fill& fill,
                                      const VolumeWriteOptions& options, const Context& context) {
  const bool compress = options.compress;
  const Format format = format_of(path);
  switch (format) {
    case Format::kVol:
      write_slices<std::uint8_t>(path, grid, vol_header(grid, false, compress), compress, fill,
                                 context);
      break;
    case Format::kLongvol:
      write_slices<std::uint64_t>(path, grid, vol_header(grid, true, compress), compress, fill,
                                  context);
      break;
    case Format::kNpy:
      write_slices<Kept>(path, grid, npy_header(grid, descr), false, fill, context);
      break;
    case Format::kVti:
      write_vti<Kept>(path, grid, options, fill, context);
      break;
  }
  return left_out(format, grid, options.world);
}

/// The same of the values that slice_of(z) has. \throws InputError where one does not fit the form.
template <class Kept, class SliceOf>
std::vector<std::string> write_values(const std::string& path, const Grid& grid,
                                      const SliceOf& slice_of, const VolumeWriteOptions& options,
                                      const Context& context) {
  const Index slice = grid.size[0] * grid.size[1];
  const auto convert = [&](Index z, auto* to) {
    using T = std::remove_pointer_t<decltype(to)>;
    const auto& values = slice_of(z);
    for (Index k = 0; k < slice; ++k) {
      to[k] = fitting<T>(values[static_cast<std::size_t>(k)], z * slice + k, grid, path);
    }
  };
  return write_filled<Kept>(path, grid, descr_of<Kept>(), convert, options, context);
}

/// The labels of a slice, x fastest.
std::vector<Label> labels_of(const LabelVolume& volume, Index z) {
  const Index3& size = volume.grid().size;
  std::vector<Label> labels(static_cast<std::size_t>(size[0] * size[1]));
  for (Index y = 0; y < size[1]; ++y) volume.row(y, z, labels.data() + y * size[0]);
  return labels;
}

}  // namespace

std::string written_volume_endings() { return ".vol, .longvol, .npy and .vti"; }

bool is_written_volume_path(const std::string& path) { return known_format(path).has_value(); }

bool keeps_spacing(const std::string& path) { return format_of(path) != Format::kNpy; }

void check_volume_path(const std::string& path) {
  (void)format_of(path);
  check_writable(path);
}

std::vector<std::string> write_volume(const std::string& path, const BinaryVolume& volume,
                                      const VolumeWriteOptions& options, const Context& context) {
  const Grid& grid = volume.grid();
  check_grid(grid, path);
  const auto fill = [&](Index z, auto* to) {
    for (Index y = 0; y < grid.size[1]; ++y) {
      for (Index x = 0; x < grid.size[0]; ++x) *to++ = volume(x, y, z) ? 1 : 0;
    }
  };
  return write_filled<std::uint8_t>(path, grid, "|b1", fill, options, context);
}

std::vector<std::string> write_volume(const std::string& path, const LabelVolume& volume,
                                      const VolumeWriteOptions& options, const Context& context) {
  const Grid& grid = volume.grid();
  check_grid(grid, path);
  const auto slice_of = [&](Index z) { return labels_of(volume, z); };
  switch (volume.largest()) {
    case std::numeric_limits<std::uint8_t>::max():
      return write_values<std::uint8_t>(path, grid, slice_of, options, context);
    case std::numeric_limits<std::uint16_t>::max():
      return write_values<std::uint16_t>(path, grid, slice_of, options, context);
    default:
      return write_values<std::uint32_t>(path, grid, slice_of, options, context);
  }
}

std::vector<std::string> write_volume(const std::string& path, const Grid& grid,
                                      const VoxelValues& values, const VolumeWriteOptions& options,
                                      const Context& context) {
  (void)format_of(path);
  check_grid(grid, path);
  return std::visit(
      [&](auto span) {
        using From = std::remove_cv_t<typename decltype(span)::element_type>;
        if (static_cast<Index>(span.size()) != grid.voxels()) {
          throw InputError("'" + path + "': " + std::to_string(span.size()) +
                           " values were given for a grid of " + std::to_string(grid.voxels()) +
                           " voxels");
        }
        const auto slice = static_cast<std::size_t>(grid.size[0] * grid.size[1]);
        const auto slice_of = [&](Index z) {
          return span.subspan(static_cast<std::size_t>(z) * slice, slice);
        };
        return write_values<From>(path, grid, slice_of, options, context);
      },
      values);
}

}  // namespace dsc
