// .vol and .longvol: see volume_source.h for the format.
#include "libdsc/base/error.h"
#include "libdsc/io/data_size.h"
#include "libdsc/io/volume_formats.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

namespace dsc::detail {
namespace {

constexpr Index kLongestHeader = Index{1} << 16;

/// The header's lines, each value with the byte where its line begins.
class Header {
 public:
  /// Reads up to the line "."; the file then stands at the first byte of the data.
  explicit Header(InputFile& file) : file_(file) {
    std::string text(static_cast<std::size_t>(std::min(file.size(), kLongestHeader)), '\0');
    file.read(text.data(), static_cast<Index>(text.size()));
    std::size_t begin = 0;
    for (;;) {
      const std::size_t end = text.find('\n', begin);
      const auto at = static_cast<Index>(begin);
      if (end == std::string::npos) {
        file.fail(at, "the header has no end, a line with a dot; is this a .vol file?");
      }
      const std::string_view line = std::string_view(text).substr(begin, end - begin);
      begin = end + 1;
      if (line == ".") break;
      add(line, at);
    }
    file.seek(static_cast<Index>(begin));
  }

  bool has(const char* key) const { return lines_.count(key) > 0; }
  Index at(const char* key) const { return lines_.find(key)->second.at; }
  const std::string& text(const char* key) const { return lines_.find(key)->second.text; }

  Index integer(const char* key) const {
    if (!has(key)) file_.fail(0, std::string("the header lacks the key ") + key);
    Index value = 0;
    const std::string& digits = text(key);
    const char* end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, value);
    if (error != std::errc{} || stop != end) {
      file_.fail(at(key), std::string(key) + ": '" + digits + "' is not a 64-bit integer");
    }
    return value;
  }

  double positive(const char* key) const {
    double value = 0;
    const std::string& digits = text(key);
    const char* end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, value);
    if (error != std::errc{} || stop != end || !(value > 0) || !std::isfinite(value)) {
      file_.fail(at(key), std::string(key) + ": '" + digits + "' is not a positive number");
    }
    return value;
  }

 private:
  struct Line {
    Index at;
    std::string text;
  };

  void add(std::string_view line, Index at) {
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos || colon == 0) {
      file_.fail(at, "a header line must read 'Key: value'; is this a .vol file?");
    }
    std::string_view value = line.substr(colon + 1);
    const std::size_t first = value.find_first_not_of(' ');
    const std::size_t last = value.find_last_not_of(' ');
    value = first == std::string_view::npos ? "" : value.substr(first, last - first + 1);
    const std::string key(line.substr(0, colon));
    if (!lines_.emplace(key, Line{at, std::string(value)}).second) {
      file_.fail(at, "the header key " + key + " is given twice");
    }
  }

  InputFile& file_;
  std::map<std::string, Line, std::less<>> lines_;
};

/// Inflates the rest of a file, `total` bytes and not one more.
class Inflater {
 public:
  Inflater(InputFile& file, Index total)
      : file_(file),
        left_(total),
        in_(static_cast<std::size_t>(std::clamp<Index>(file.remaining(), 1, Index{1} << 18))) {
    if (inflateInit(&stream_) != Z_OK) throw LimitError("zlib: no memory to inflate");
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() { (void)inflateEnd(&stream_); }

  void next(void* to, Index bytes) {
    constexpr Index kChunk = Index{1} << 30;  // zlib counts in 32 bits
    auto* out = static_cast<Bytef*>(to);
    while (bytes > 0) {
      const Index chunk = std::min(bytes, kChunk);
      stream_.next_out = out;
      stream_.avail_out = static_cast<uInt>(chunk);
      while (stream_.avail_out > 0) {
        if (ended_) {
          fail("the compressed data ends " +
               std::to_string(left_ - (chunk - static_cast<Index>(stream_.avail_out))) +
               " bytes before the volume is full");
        }
        step();
      }
      out += chunk;
      bytes -= chunk;
      left_ -= chunk;
    }
  }

  /// The stream, its checksum and the file must end where the volume does.
  void finish() {
    Bytef beyond = 0;
    while (!ended_) {
      stream_.next_out = &beyond;
      stream_.avail_out = 1;
      step();
      if (stream_.avail_out == 0) {
        fail("the compressed data goes on after the volume is full; are X, Y, Z right?");
      }
    }
    if (stream_.avail_in > 0 || file_.remaining() > 0) {
      fail("the file goes on after the end of the compressed data");
    }
  }

 private:
  void step() {
    if (stream_.avail_in == 0) {
      const Index count = file_.read_some(in_.data(), static_cast<Index>(in_.size()));
      if (count == 0) fail("the file ends inside the compressed data; it is truncated");
      stream_.next_in = in_.data();
      stream_.avail_in = static_cast<uInt>(count);
    }
    const int result = inflate(&stream_, Z_NO_FLUSH);
    if (result == Z_STREAM_END) {
      ended_ = true;
    } else if (result == Z_MEM_ERROR) {
      throw LimitError("zlib: no memory to inflate");
    } else if (result != Z_OK && result != Z_BUF_ERROR) {
      fail(std::string("the compressed data is damaged: ") +
           (stream_.msg != nullptr ? stream_.msg : "a preset dictionary is not supported"));
    }
  }

  [[noreturn]] void fail(const std::string& why) const {
    file_.fail(file_.position() - static_cast<Index>(stream_.avail_in), why);
  }

  InputFile& file_;
  Index left_;
  std::vector<Bytef> in_;
  z_stream stream_{};
  bool ended_ = false;
};

class VolSource final : public VolumeSource {
 public:
  VolSource(InputFile file, bool longvol) : file_(std::move(file)) {
    const Header header(file_);
    type_.bytes = longvol ? 8 : 1;
    type_.swap = longvol && std::endian::native == std::endian::big;
    read_grid(header);
    check_layout(header, longvol);
    check_length();
  }

  const std::string& path() const override { return file_.path(); }
  const Grid& grid() const override { return grid_; }
  bool x_fastest() const override { return true; }

  void read(const std::function<void(const Slab&)>& take, const Context& context) override {
    const Index slice = grid_.size[0] * grid_.size[1];
    if (!compressed_) {
      stream_slabs(
          grid_.size[2], slice, type_, [&](void* to, Index bytes) { file_.read(to, bytes); }, take,
          context);
      return;
    }
    Inflater inflater(file_, bytes_);
    stream_slabs(
        grid_.size[2], slice, type_, [&](void* to, Index bytes) { inflater.next(to, bytes); }, take,
        context);
    inflater.finish();
  }

 private:
  void read_grid(const Header& header) {
    const char* const sizes[] = {"X", "Y", "Z"};
    const char* const spacings[] = {"Spacing-X", "Spacing-Y", "Spacing-Z"};
    for (int axis = 0; axis < 3; ++axis) {
      const Index size = header.integer(sizes[axis]);
      if (size <= 0) {
        file_.fail(
            header.at(sizes[axis]),
            std::string(sizes[axis]) + ": the size must be positive, not " + std::to_string(size));
      }
      grid_.size[static_cast<std::size_t>(axis)] = size;
      if (header.has(spacings[axis])) grid_.spacing[axis] = header.positive(spacings[axis]);
    }
  }

  void check_layout(const Header& header, bool longvol) {
    if (!header.has("Version")) {
      file_.fail(0,
                 "the header lacks the key Version (the old version 1); save the file anew as "
                 "version 2 or 3");
    }
    const Index version = header.integer("Version");
    if (version != 2 && version != 3) {
      file_.fail(header.at("Version"), "Version " + std::to_string(version) +
                                           " is unknown; 2 (raw) and 3 (zlib) are read");
    }
    compressed_ = version == 3;
    const char* key = longvol ? "Lvoxel-Size" : "Voxel-Size";
    if (header.has(key)) {
      // DGtal writes 4 in .longvol files although its voxels have 8 bytes.
      const Index bytes = header.integer(key);
      const bool known = longvol ? bytes == 8 || bytes == 4 : bytes == 1;
      if (!known) {
        file_.fail(header.at(key), std::string(key) + ": " + std::to_string(bytes) +
                                       " bytes a voxel are not supported; " +
                                       (longvol ? "8 are" : "1 is, more in .longvol"));
      }
    }
    if (longvol && header.has("Int-Endian") && header.text("Int-Endian") != "0123") {
      file_.fail(header.at("Int-Endian"), "Int-Endian: only 0123 (little-endian) is supported");
    }
  }

  void check_length() {
    bytes_ = data_bytes(file_, 0, grid_, type_.bytes);
    const Index left = file_.remaining();
    if (!compressed_ && left != bytes_) {
      file_.fail(file_.size(), "the header promises " + std::to_string(bytes_) +
                                   " bytes of data, the file holds " + std::to_string(left) +
                                   (left < bytes_ ? "; it is truncated" : "; it is too long"));
    }
    // Deflate cannot shrink data by more than 1032.
    if (compressed_ && bytes_ / 1032 > left) {
      file_.fail(file_.size(),
                 "the header promises " + std::to_string(bytes_) +
                     " bytes of data, more than the file's " + std::to_string(left) +
                     " compressed bytes can hold; it is truncated or X, Y, Z are wrong");
    }
  }

  InputFile file_;
  Grid grid_;
  ValueType type_;
  Index bytes_ = 0;
  bool compressed_ = false;
};

}  // namespace

std::unique_ptr<VolumeSource> open_vol(InputFile file, bool longvol) {
  return std::make_unique<VolSource>(std::move(file), longvol);
}

}  // namespace dsc::detail
