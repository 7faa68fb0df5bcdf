#include "libdsc/io/itk/completeness.h"

#include "libdsc/io/itk/image.h"

#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
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

/// `a` times `n`. \throws ImageTooLarge where 64 bits cannot hold it.
Size times(Size a, Size n) {
  Size product = 0;
  if (__builtin_mul_overflow(a, n, &product)) {
    throw ImageTooLarge("the header promises more than 64 bits can count");
  }
  return product;
}

/// The bytes that a zlib or gzip stream inflates to, which lies in `length` bytes of the file from
/// `offset` on; some number above `enough` where there are more.
Size inflated_bytes(const std::string& path, Size offset, Size length, Size enough) {
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(offset));
  z_stream stream{};
  if (inflateInit2(&stream, 15 + 32) != Z_OK) throw std::bad_alloc();
  std::vector<char> in(1 << 18), out(1 << 18);
  Size total = 0;
  int result = Z_OK;
  while ((result == Z_OK || result == Z_BUF_ERROR) && total <= enough) {
    if (stream.avail_in == 0) {
      file.read(in.data(), static_cast<std::streamsize>(std::min<Size>(in.size(), length)));
      stream.next_in = reinterpret_cast<Bytef*>(in.data());
      stream.avail_in = static_cast<uInt>(file.gcount());
      length -= stream.avail_in;
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
    const auto version = number_at<std::uint16_t>(start, 2, swap_);
    big_ = version == 43;
    if (start[0] != start[1] || (start[0] != 'I' && !swap_) || (version != 42 && !big_)) {
      throw ImageError("this is no TIFF file");
    }
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

/// The bytes of a value of a NIfTI type; 0 where it is none of a number.
Size nifti_bytes(int type) {
  switch (type) {
    case 2:    // 8 bits, unsigned
    case 256:  // signed
      return 1;
    case 4:
    case 512:
      return 2;
    case 8:
    case 16:  // float
    case 768:
      return 4;
    case 64:  // double
    case 1024:
    case 1280:
      return 8;
    default:
      return 0;
  }
}

void check_nifti(const std::string& path) {
  GzFile file(path);
  std::vector<char> start(352);
  Size there = file.read(start.data(), static_cast<unsigned>(start.size()));
  if (there >= 4) {
    for (const bool swap : {false, true}) {
      if (number_at<std::int32_t>(start, 0, swap) == 540) {
        throw ImageError("NIfTI-2 is not read; save the image as NIfTI-1 or NRRD");
      }
    }
  }
  if (there < 348) truncated(348, there);
  const bool swap = number_at<std::int32_t>(start, 0, false) != 348;
  // Where the values begin: ITK reads them from within the header, or from nowhere.
  const double offset = number_at<float>(start, 108, swap);
  if (!(offset >= 352 && offset < 0x1p31)) {
    throw ImageError("the header says that the values begin at byte " + std::to_string(offset) +
                     "; it is damaged");
  }
  const Size value = nifti_bytes(number_at<std::int16_t>(start, 70, swap));
  if (value == 0) throw ImageError("its values are no integers or floats of up to 64 bits");
  Size promised = value;
  const int dims = number_at<std::int16_t>(start, 40, swap);
  for (int d = 1; d <= std::clamp(dims, 0, 7); ++d) {
    const auto size = number_at<std::int16_t>(start, static_cast<std::size_t>(40 + 2 * d), swap);
    promised = times(promised, static_cast<Size>(std::max<std::int16_t>(1, size)));
  }
  if (__builtin_add_overflow(promised, static_cast<Size>(offset), &promised)) {
    throw ImageTooLarge("the header promises more than 64 bits can count");
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

void check_nrrd(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  for (std::string line; std::getline(file, line) && !line.empty() && line != "\r";) {
    if (!line.starts_with("encoding:")) continue;
    const std::size_t first = line.find_first_not_of(" \t", 9);
    const std::string encoding = first == std::string::npos ? "" : line.substr(first);
    for (const char* text : {"ascii", "text", "txt"}) {
      if (encoding.starts_with(text)) {
        throw ImageError("its values are written as text; save them as raw or gzip");
      }
    }
  }
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
  const bool compressed = is_true(header["CompressedData"]);
  const Size size = std::filesystem::file_size(where);
  Size offset = local ? static_cast<Size>(file.tellg()) : 0;
  if (header.contains("HeaderSize")) {  // which MetaIO follows, in this file too
    const long long skipped = std::atoll(header["HeaderSize"].c_str());
    if (skipped > 0) offset = static_cast<Size>(skipped);
    if (skipped < 0 && !compressed) offset = size - std::min(size, bytes);  // the file's end
  }
  offset = std::min(size, offset);
  Size there = size - offset;
  if (compressed) {
    Size length = there;
    if (header.contains("CompressedDataSize")) {
      const long long given = std::atoll(header["CompressedDataSize"].c_str());
      if (given <= 0) throw ImageError("CompressedDataSize is not positive");
      length = std::min(length, static_cast<Size>(given));
    } else if (local) {
      throw ImageError("the header lacks CompressedDataSize");  // MetaIO would read zeros
    }
    there = inflated_bytes(where, offset, length, bytes);
  }
  if (there < bytes) truncated(bytes, there);
}

void check_nrrd_size(const std::string& path, std::uint64_t bytes) {
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
  Size entries = 0;
  for (Size at = file.offset(file.big() ? 8 : 4); at != 0;) {
    const Size count = file.big() ? file.number<std::uint64_t>(at) : file.number<std::uint16_t>(at);
    const Size first = at + (file.big() ? 8 : 2);
    if (count > file.size()) throw ImageError("a TIFF directory is damaged");
    // Each has bytes of its own, unless directories lead back to themselves or lie on each other.
    entries += std::max<Size>(1, count);
    if (entries > file.size() / entry) throw ImageError("the TIFF directories run in a circle");
    std::vector<Size> offsets, lengths;
    for (Size e = first; e < first + count * entry; e += entry) {
      const Size tag = file.number<std::uint16_t>(e);
      const bool of_offsets = tag == 273 || tag == 324, of_lengths = tag == 279 || tag == 325;
      if (!of_offsets && !of_lengths) continue;
      std::vector<Size>& numbers = of_offsets ? offsets : lengths;
      if (!numbers.empty()) throw ImageError("a TIFF directory has an entry twice");
      numbers = file.values(e);
    }
    for (Size i = 0; i < std::min(offsets.size(), lengths.size()); ++i) {
      file.check(offsets[i], lengths[i]);
    }
    at = file.offset(first + count * entry);
  }
}

void check_dicom(const DicomPixels& found, std::uint64_t pixels) {
  if (!found.compressed) {
    const Size bytes = (pixels * found.bits + 7) / 8;
    if (found.bytes < bytes) truncated(bytes, found.bytes);
  }
}

}  // namespace dsc::detail
