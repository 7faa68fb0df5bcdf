#include "libdsc/io/itk/completeness.h"

#include "libdsc/io/itk/image.h"

#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string_view>
#include <vector>

namespace dsc::detail {
namespace {

using Size = std::uint64_t;

[[noreturn]] void truncated(Size promised, Size there) {
  throw ImageError("the header promises " + std::to_string(promised) + " bytes, the file holds " +
                   std::to_string(there) + "; it is truncated");
}

/// Bytes of a file, or of what a gzip file inflates to.
class GzFile {
 public:
  explicit GzFile(const std::string& path) : file_(::gzopen(path.c_str(), "rb")) {
    if (file_ == nullptr) throw ImageError("it cannot be opened");
    (void)::gzbuffer(file_, 1 << 18);
  }
  GzFile(const GzFile&) = delete;
  GzFile& operator=(const GzFile&) = delete;
  ~GzFile() { (void)::gzclose(file_); }

  bool compressed() { return ::gzdirect(file_) == 0; }

  /// At most `bytes`. \throws ImageError on damaged or truncated compressed data.
  Size read(void* to, unsigned bytes) {
    const int n = ::gzread(file_, to, bytes);
    int error = Z_OK;
    const char* message = ::gzerror(file_, &error);
    if (n < 0 || (error != Z_OK && error != Z_STREAM_END)) {
      throw ImageError(std::string("the compressed data is damaged or truncated: ") + message);
    }
    return static_cast<Size>(n);
  }

 private:
  gzFile file_;
};

/// An integer of a file whose byte order may be the other one.
template <class T>
T number_at(const std::vector<char>& bytes, std::size_t at, bool swap) {
  T value{};
  std::memcpy(&value, bytes.data() + at, sizeof value);
  if (swap) {
    auto* raw = reinterpret_cast<unsigned char*>(&value);
    std::reverse(raw, raw + sizeof value);
  }
  return value;
}

/// `a` times what may be a negative number of a damaged header.
Size times(Size a, std::int64_t n) {
  Size product = 0;
  if (n < 0) throw ImageError("the header has a negative size");
  if (__builtin_mul_overflow(a, static_cast<Size>(n), &product)) {
    throw ImageTooLarge("the header promises more than 64 bits can count");
  }
  return product;
}

/// The bytes that a zlib or gzip stream inflates to, from `offset` of the file on; some number
/// above `enough` where there are more.
Size inflated_bytes(const std::string& path, Size offset, Size enough) {
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(offset));
  z_stream stream{};
  if (inflateInit2(&stream, 15 + 32) != Z_OK) throw std::bad_alloc();
  std::vector<char> in(1 << 18), out(1 << 18);
  Size total = 0;
  int result = Z_OK;
  while ((result == Z_OK || result == Z_BUF_ERROR) && total <= enough) {
    if (stream.avail_in == 0) {
      file.read(in.data(), static_cast<std::streamsize>(in.size()));
      stream.next_in = reinterpret_cast<Bytef*>(in.data());
      stream.avail_in = static_cast<uInt>(file.gcount());
      if (stream.avail_in == 0) break;
    }
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    result = inflate(&stream, Z_NO_FLUSH);
    total += out.size() - stream.avail_out;
  }
  (void)inflateEnd(&stream);
  if (result != Z_STREAM_END && total <= enough)
    throw ImageError("the compressed data is damaged or truncated");
  return total;
}

/// A TIFF file's numbers, wherever they are.
class TiffBytes {
 public:
  explicit TiffBytes(const std::string& path)
      : file_(path, std::ios::binary), size_(std::filesystem::file_size(path)) {
    const std::vector<char> start = bytes(0, 8);
    swap_ = start[0] == 'M';
    big_ = number_at<std::uint16_t>(start, 2, swap_) == 43;
  }

  bool big() const { return big_; }
  Size size() const { return size_; }

  std::vector<char> bytes(Size at, Size count) {
    check(at, count);
    std::vector<char> found(count);
    file_.seekg(static_cast<std::streamoff>(at));
    file_.read(found.data(), static_cast<std::streamsize>(count));
    return found;
  }
  void check(Size at, Size count) const {
    if (at > size_ || count > size_ - at) truncated(at + count, size_);
  }

  template <class T>
  Size number(Size at) {
    return number_at<T>(bytes(at, sizeof(T)), 0, swap_);
  }
  /// An offset, or a count in an entry.
  Size offset(Size at) { return big_ ? number<std::uint64_t>(at) : number<std::uint32_t>(at); }

  /// The numbers of the entry at `at`.
  std::vector<Size> values(Size at) {
    const Size type = number<std::uint16_t>(at + 2);
    const Size width = type == 3 ? 2 : type == 4 ? 4 : type == 16 ? 8 : 0;
    const Size count = offset(at + 4);
    const Size room = big_ ? 8 : 4;
    if (width == 0 || count > size_) throw ImageError("a TIFF directory is damaged");
    const Size first = at + 4 + room;
    const Size where = count * width <= room ? first : offset(first);
    const std::vector<char> raw = bytes(where, count * width);
    std::vector<Size> found;
    for (Size i = 0; i < count; ++i) {
      found.push_back(width == 2   ? number_at<std::uint16_t>(raw, 2 * i, swap_)
                      : width == 4 ? number_at<std::uint32_t>(raw, 4 * i, swap_)
                                   : number_at<std::uint64_t>(raw, 8 * i, swap_));
    }
    return found;
  }

 private:
  std::ifstream file_;
  Size size_;
  bool swap_ = false;
  bool big_ = false;
};

std::map<std::string, std::string> meta_header(std::ifstream& file) {
  const auto trimmed = [](const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\r");
    return first == std::string::npos
               ? std::string()
               : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
  };
  std::map<std::string, std::string> header;
  for (std::string line; std::getline(file, line);) {
    const std::size_t sign = line.find('=');
    if (sign == std::string::npos) continue;
    const std::string key = trimmed(line.substr(0, sign));
    header[key] = trimmed(line.substr(sign + 1));
    if (key == "ElementDataFile") return header;
  }
  throw ImageError("the header has no line ElementDataFile; it is truncated");
}

bool is_true(const std::string& text) {
  return !text.empty() && (text[0] == 'T' || text[0] == 't');
}

}  // namespace

void check_nifti(const std::string& path) {
  GzFile file(path);
  std::vector<char> start(540);
  Size there = file.read(start.data(), static_cast<unsigned>(start.size()));
  if (there < 348) truncated(348, there);
  bool swap = false;
  std::int32_t header = number_at<std::int32_t>(start, 0, false);
  if (header != 348 && header != 540) {
    swap = true;
    header = number_at<std::int32_t>(start, 0, true);
  }
  const bool second = header == 540;
  Size promised = 0;
  if (second) {
    const auto dims = number_at<std::int64_t>(start, 16, swap);
    promised = static_cast<Size>(number_at<std::int16_t>(start, 14, swap)) / 8;
    for (std::int64_t d = 1; d <= std::clamp<std::int64_t>(dims, 0, 7); ++d) {
      promised = times(promised,
                       number_at<std::int64_t>(start, static_cast<std::size_t>(16 + 8 * d), swap));
    }
    const auto offset = number_at<std::int64_t>(start, 168, swap);
    if (offset < 0 || __builtin_add_overflow(promised, static_cast<Size>(offset), &promised)) {
      throw ImageError("its values begin at the impossible byte " + std::to_string(offset));
    }
  } else {
    const int dims = number_at<std::int16_t>(start, 40, swap);
    promised = static_cast<Size>(number_at<std::int16_t>(start, 72, swap)) / 8;
    for (int d = 1; d <= std::clamp(dims, 0, 7); ++d) {
      const auto size = number_at<std::int16_t>(start, static_cast<std::size_t>(40 + 2 * d), swap);
      promised = times(promised, std::max<std::int16_t>(1, size));
    }
    promised += static_cast<Size>(std::max(0.F, number_at<float>(start, 108, swap)));
  }
  if (file.compressed()) {
    std::vector<char> buffer(1 << 18);
    // To the end, where the checksum is; no further than promised where there is more.
    for (Size n = 1; n > 0 && there <= promised; there += n) {
      n = file.read(buffer.data(), static_cast<unsigned>(buffer.size()));
    }
  } else {
    there = std::filesystem::file_size(path);
  }
  if (there < promised) truncated(promised, there);
}

void check_meta(const std::string& path, std::uint64_t bytes) {
  std::ifstream file(path, std::ios::binary);
  auto header = meta_header(file);
  const std::string data = header["ElementDataFile"];
  if (data == "LIST" || data.find('%') != std::string::npos) {
    throw ImageError("its values lie in a list of files; save them in one");
  }
  const auto binary = header.find("BinaryData");
  if (binary != header.end() && !is_true(binary->second)) {
    throw ImageError("its values are written as text; save them as binary");
  }
  const bool local = data == "LOCAL" || data == "Local" || data == "local";
  const std::string where =
      local ? path : (std::filesystem::path(path).parent_path() / data).string();
  Size offset = local ? static_cast<Size>(file.tellg()) : 0;
  if (!local && header.contains("HeaderSize")) {
    const long long skipped = std::atoll(header["HeaderSize"].c_str());
    offset = skipped > 0 ? static_cast<Size>(skipped) : 0;
  }
  const bool compressed = is_true(header["CompressedData"]);
  if (compressed && local && !header.contains("CompressedDataSize")) {
    throw ImageError("the header lacks CompressedDataSize");  // MetaIO would read zeros
  }
  const Size size = std::filesystem::file_size(where);
  const Size there =
      compressed ? inflated_bytes(where, offset, bytes) : size - std::min(size, offset);
  if (there < bytes) truncated(bytes, there);
}

void check_nrrd(const std::string& path, std::uint64_t bytes) {
  std::ifstream file(path, std::ios::binary);
  std::string data, encoding;
  const auto field = [](const std::string& line, const std::string& key) {
    const std::size_t first = line.find_first_not_of(' ', key.size());
    const std::size_t last = line.find_last_not_of(" \t\r");
    return first == std::string::npos || last < first ? std::string()
                                                      : line.substr(first, last + 1 - first);
  };
  for (std::string line; std::getline(file, line) && !line.empty() && line != "\r";) {
    for (const char* key : {"data file:", "datafile:"}) {
      if (line.rfind(key, 0) == 0) data = field(line, key);
    }
    if (line.rfind("encoding:", 0) == 0) encoding = field(line, "encoding:");
  }
  std::filesystem::path where(path);
  if (!data.empty()) where = where.parent_path() / data;
  if (!std::filesystem::is_regular_file(where)) return;  // a list of files, or ITK tells
  const Size size = std::filesystem::file_size(where);
  // Bytes of values for one of the file: deflate shrinks by 1032 at most, bzip2 by far more.
  const Size most = encoding == "raw" ? 1 : encoding == "gzip" || encoding == "gz" ? 1032 : 100000;
  if (bytes / most > size) truncated(bytes, size);
}

void check_tiff(const std::string& path) {
  TiffBytes file(path);
  const Size entry = file.big() ? 20 : 12;
  Size directories = 0;
  for (Size at = file.offset(file.big() ? 8 : 4); at != 0; ++directories) {
    if (directories > file.size() / 16) throw ImageError("the TIFF directories run in a circle");
    const Size count = file.big() ? file.number<std::uint64_t>(at) : file.number<std::uint16_t>(at);
    const Size first = at + (file.big() ? 8 : 2);
    if (count > file.size()) throw ImageError("a TIFF directory is damaged");
    std::vector<Size> offsets, lengths;
    for (Size e = first; e < first + count * entry; e += entry) {
      const Size tag = file.number<std::uint16_t>(e);
      if (tag == 273 || tag == 324) offsets = file.values(e);
      if (tag == 279 || tag == 325) lengths = file.values(e);
    }
    for (Size i = 0; i < std::min(offsets.size(), lengths.size()); ++i) {
      file.check(offsets[i], lengths[i]);
    }
    at = file.offset(first + count * entry);
  }
}

void check_dicom(const std::string& path, std::uint64_t pixels) {
  constexpr std::string_view kPixelData("\xe0\x7f\x10\x00", 4);
  constexpr std::string_view kSequenceEnd("\xfe\xff\xdd\xe0\0\0\0\0", 8);
  constexpr Size kUndefined = 0xffffffff;  // a sequence of compressed fragments
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  const std::string_view text(bytes.data(), bytes.size());
  bool found = false;
  // There may be several: small previews, or by chance the same bytes among the pixels.
  for (Size at = 0; (at = text.find(kPixelData, at)) != std::string_view::npos; at += 4) {
    if (at + 12 > text.size()) break;
    const std::string_view type = text.substr(at + 4, 2);
    const bool with_type = type == "OW" || type == "OB";
    const Size length = number_at<std::uint32_t>(bytes, at + (with_type ? 8 : 4), false);
    const Size first = at + (with_type ? 12 : 8);
    found = true;
    if (length == kUndefined) {
      if (text.find(kSequenceEnd, first) != std::string_view::npos) return;
    } else if (length >= pixels && length <= text.size() - first) {
      return;
    }
  }
  if (found) throw ImageError("its pixel data goes on after the end of the file; it is truncated");
}

}  // namespace dsc::detail
