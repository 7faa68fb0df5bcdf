#include "libdsc/io/volume_writer.h"

#include "libdsc/base/error.h"
#include "libdsc/base/parallel.h"
#include "libdsc/io/atomic_file.h"
#include "libdsc/io/path_extension.h"

#include <zlib.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace dsc {
namespace {

enum class Format { kVol, kLongvol, kNpy, kVti };

Format format_of(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == ".vol") return Format::kVol;
  if (extension == ".longvol") return Format::kLongvol;
  if (extension == ".npy") return Format::kNpy;
  if (extension == ".vti") return Format::kVti;
  throw UsageError("'" + path + "': the extension '" + extension +
                   "' is no volume format; .vol, .longvol, .npy and .vti are written");
}

std::string number(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

std::string vol_header(const Grid& grid, bool longvol, bool compress) {
  const char* const axes[] = {"X", "Y", "Z"};
  std::string text;
  for (std::size_t a = 0; a < 3; ++a) {
    text += std::string("Center-") + axes[a] + ": " + std::to_string(grid.size[a] / 2) + "\n";
  }
  for (std::size_t a = 0; a < 3; ++a) {
    text += std::string(axes[a]) + ": " + std::to_string(grid.size[a]) + "\n";
  }
  if (grid.spacing != Vec3::Ones()) {
    for (std::size_t a = 0; a < 3; ++a) {
      text += std::string("Spacing-") + axes[a] + ": " + number(grid.spacing[int(a)]) + "\n";
    }
  }
  const std::string prefix = longvol ? "Lvoxel" : "Voxel";
  return text + prefix + "-Size: " + (longvol ? "8" : "1") + "\nAlpha-Color: 0\n" + prefix +
         "-Endian: 0\nInt-Endian: 0123\nVersion: " + (compress ? "3" : "2") + "\n.\n";
}

std::string npy_header(const Grid& grid, const std::string& descr) {
  std::string text = "{'descr': '" + descr + "', 'fortran_order': False, 'shape': (" +
                     std::to_string(grid.size[2]) + ", " + std::to_string(grid.size[1]) + ", " +
                     std::to_string(grid.size[0]) + "), }";
  text.append(63 - (10 + text.size()) % 64, ' ');  // the data begins at a multiple of 64
  text += '\n';
  const auto length = static_cast<unsigned>(text.size());
  const std::string start = {'\x93',
                             'N',
                             'U',
                             'M',
                             'P',
                             'Y',
                             '\x01',
                             '\x00',
                             static_cast<char>(length & 255),
                             static_cast<char>(length >> 8)};
  return start + text;
}

/// The XML before the values, which are appended raw; voxels are the points of the image.
std::string vti_header(const Grid& grid, const RigidMap& world, const std::string& type,
                       bool compress) {
  const auto numbers = [](const auto& v) {
    std::string text;
    for (Index i = 0; i < v.size(); ++i) text += (i > 0 ? " " : "") + number(v(i));
    return text;
  };
  std::string extent;
  for (const Index size : grid.size) {
    extent += (extent.empty() ? "0 " : " 0 ") + std::to_string(size - 1);
  }
  const Mat3 rows = world.rotation.transpose();  // Eigen counts down the columns
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\"";
  if (compress) text += " compressor=\"vtkZLibDataCompressor\"";
  text += ">\n<ImageData WholeExtent=\"" + extent + "\" Origin=\"" + numbers(world(grid.origin)) +
          "\" Spacing=\"" + numbers(grid.spacing) + "\"";
  if (!world.rotation.isIdentity(0)) text += " Direction=\"" + numbers(rows.reshaped()) + "\"";
  return text + ">\n<Piece Extent=\"" + extent +
         "\">\n<PointData Scalars=\"values\">\n<DataArray type=\"" + type +
         "\" Name=\"values\" format=\"appended\" offset=\"0\"/>\n</PointData>\n</Piece>\n"
         "</ImageData>\n<AppendedData encoding=\"raw\">\n_";
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
      std::vector<T> values(static_cast<std::size_t>(slice));
      fill(z, values.data());
      std::vector<Bytef>& block = blocks[static_cast<std::size_t>(z)];
      uLongf size = compressBound(bytes);
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

template <class From>
void write_typed(const std::string& path, const Grid& grid, std::span<const From> values,
                 const VolumeWriteOptions& options, const Context& context) {
  const bool compress = options.compress;
  const Index slice = grid.size[0] * grid.size[1];
  const auto convert = [&](Index z, auto* to) {
    using T = std::remove_pointer_t<decltype(to)>;
    for (Index k = 0; k < slice; ++k) {
      const Index at = z * slice + k;
      to[k] = fitting<T>(values[static_cast<std::size_t>(at)], at, grid, path);
    }
  };
  switch (format_of(path)) {
    case Format::kVol:
      return write_slices<std::uint8_t>(path, grid, vol_header(grid, false, compress), compress,
                                        convert, context);
    case Format::kLongvol:
      return write_slices<std::uint64_t>(path, grid, vol_header(grid, true, compress), compress,
                                         convert, context);
    case Format::kNpy:
      return write_slices<From>(path, grid, npy_header(grid, descr_of<From>()), false, convert,
                                context);
    case Format::kVti:
      return write_vti<From>(path, grid, options, convert, context);
  }
}

}  // namespace

void write_volume(const std::string& path, const BinaryVolume& volume,
                  const VolumeWriteOptions& options, const Context& context) {
  const Grid& grid = volume.grid();
  const Format format = format_of(path);
  check_grid(grid, path);
  const auto fill = [&](Index z, auto* to) {
    for (Index y = 0; y < grid.size[1]; ++y) {
      for (Index x = 0; x < grid.size[0]; ++x) *to++ = volume(x, y, z) ? 1 : 0;
    }
  };
  switch (format) {
    case Format::kVol:
      return write_slices<std::uint8_t>(path, grid, vol_header(grid, false, options.compress),
                                        options.compress, fill, context);
    case Format::kLongvol:
      return write_slices<std::uint64_t>(path, grid, vol_header(grid, true, options.compress),
                                         options.compress, fill, context);
    case Format::kNpy:
      return write_slices<std::uint8_t>(path, grid, npy_header(grid, "|b1"), false, fill, context);
    case Format::kVti:
      return write_vti<std::uint8_t>(path, grid, options, fill, context);
  }
}

void write_volume(const std::string& path, const Grid& grid, const VoxelValues& values,
                  const VolumeWriteOptions& options, const Context& context) {
  (void)format_of(path);
  check_grid(grid, path);
  std::visit(
      [&](auto span) {
        if (static_cast<Index>(span.size()) != grid.voxels()) {
          throw InputError("'" + path + "': " + std::to_string(span.size()) +
                           " values were given for a grid of " + std::to_string(grid.voxels()) +
                           " voxels");
        }
        write_typed(path, grid, span, options, context);
      },
      values);
}

}  // namespace dsc
