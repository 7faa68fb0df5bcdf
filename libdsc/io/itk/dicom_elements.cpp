#include "libdsc/io/itk/dicom_elements.h"

#include "libdsc/io/itk/image.h"

#include <zlib.h>

#include <array>
#include <fstream>
#include <iterator>
#include <string_view>

namespace dsc::detail {
namespace {

using Size = std::uint64_t;
constexpr Size kUndefined = 0xffffffff;  // a length: up to a delimiter
constexpr Size kPreamble = 132;          // with its mark
constexpr unsigned kItem = 0xfffee000, kItemEnd = 0xfffee00d, kSequenceEnd = 0xfffee0dd;
constexpr unsigned kTransferSyntax = 0x00020010, kBits = 0x00280100, kPixelData = 0x7fe00010;

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw ImageError("it cannot be opened");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// How the elements of a part of the file are written.
struct Encoding {
  bool explicit_types = true;
  bool big_endian = false;
};

struct Element {
  unsigned tag = 0;  ///< group and number
  std::string_view type;
  Size length = 0;
};

class Walk {
 public:
  explicit Walk(std::string_view bytes) : bytes_(bytes) {}

  Size at() const { return at_; }
  bool ended() const { return at_ == bytes_.size(); }
  std::string_view rest() const { return bytes_.substr(at_); }

  std::string_view take(Size count) {
    if (count > bytes_.size() - at_) {
      throw ImageError("element at byte " + std::to_string(begin_) +
                       " goes on after the end of the file; it is truncated");
    }
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }

  Size number(int bytes, bool big_endian) {
    const std::string_view raw = take(static_cast<Size>(bytes));
    Size value = 0;
    for (std::size_t i = 0; i < raw.size(); ++i) {
      const std::size_t from = big_endian ? i : raw.size() - 1 - i;
      value = value << 8 | static_cast<unsigned char>(raw[from]);
    }
    return value;
  }

  /// The next element's head; the walk then stands at its value.
  Element element(const Encoding& encoding) {
    begin_ = at_;
    const bool big = encoding.big_endian;
    Element e;
    e.tag = static_cast<unsigned>(number(2, big) << 16);
    e.tag |= static_cast<unsigned>(number(2, big));
    const bool delimiter = e.tag == kItem || e.tag == kItemEnd || e.tag == kSequenceEnd;
    if (delimiter || !encoding.explicit_types) {
      e.length = number(4, big);
      return e;
    }
    e.type = take(2);
    for (const char c : e.type) {
      if (c < 'A' || c > 'Z') damaged();
    }
    constexpr std::array<std::string_view, 13> kLong{"OB", "OD", "OF", "OL", "OV", "OW", "SQ",
                                                     "SV", "UC", "UN", "UR", "UT", "UV"};
    bool is_long = false;
    for (const std::string_view type : kLong) is_long = is_long || type == e.type;
    if (is_long) (void)take(2);
    e.length = number(is_long ? 4 : 2, big);
    return e;
  }

  /// The items of a sequence of undefined length, up to its end.
  void skip_sequence(const Encoding& encoding, int depth) {
    if (depth > 64) damaged();
    for (;;) {
      const Element item = element(encoding);
      if (item.tag == kSequenceEnd) return;
      if (item.tag != kItem) damaged();
      if (item.length == kUndefined) {
        skip_item(encoding, depth);
      } else {
        (void)take(item.length);
      }
    }
  }

  /// The fragments of compressed values. \return their bytes.
  Size skip_fragments(const Encoding& encoding) {
    for (Size all = 0;;) {
      const Element fragment = element(encoding);
      if (fragment.tag == kSequenceEnd) return all;
      if (fragment.tag != kItem || fragment.length == kUndefined) damaged();
      all += take(fragment.length).size();
    }
  }

  void skip_value(const Element& e, const Encoding& encoding, int depth) {
    if (e.length != kUndefined) {
      (void)take(e.length);
    } else {  // of unknown type: written without types, whatever is around it
      skip_sequence(e.type == "UN" ? Encoding{false, false} : encoding, depth + 1);
    }
  }

 private:
  void skip_item(const Encoding& encoding, int depth) {
    for (;;) {
      const Element e = element(encoding);
      if (e.tag == kItemEnd) return;
      skip_value(e, encoding, depth);
    }
  }
  [[noreturn]] void damaged() const {
    throw ImageError("the element at byte " + std::to_string(begin_) + " is damaged");
  }

  std::string_view bytes_;
  Size at_ = 0;
  Size begin_ = 0;  ///< of the element
};

DicomPixels find_pixels(std::string_view bytes, const Encoding& encoding) {
  Walk walk(bytes);
  DicomPixels pixels;
  while (!walk.ended()) {
    const Element e = walk.element(encoding);
    if (e.tag == kPixelData) {
      pixels.compressed = e.length == kUndefined;
      pixels.bytes = pixels.compressed ? walk.skip_fragments(encoding) : walk.take(e.length).size();
      return pixels;
    }
    if (e.tag == kBits && e.length == 2) {
      pixels.bits = walk.number(2, encoding.big_endian);
    } else {
      walk.skip_value(e, encoding, 0);
    }
  }
  throw ImageError("it has no pixel data, or ends before it; it is truncated");
}

/// A deflated data set: a stream without a head, and a byte of padding at most.
std::string inflated(std::string_view bytes) {
  z_stream stream{};
  if (inflateInit2(&stream, -15) != Z_OK) throw std::bad_alloc();
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  std::string out;
  std::array<char, 1 << 16> block{};
  int result = Z_OK;
  while (result == Z_OK) {
    stream.next_out = reinterpret_cast<Bytef*>(block.data());
    stream.avail_out = block.size();
    result = inflate(&stream, Z_NO_FLUSH);
    out.append(block.data(), block.size() - stream.avail_out);
  }
  (void)inflateEnd(&stream);
  if (result != Z_STREAM_END) throw ImageError("the compressed data is damaged or truncated");
  return out;
}

}  // namespace

DicomPixels find_dicom_pixels(const std::string& path) {
  const std::string bytes = bytes_of(path);
  if (bytes.size() < kPreamble || bytes.compare(kPreamble - 4, 4, "DICM") != 0) {
    throw ImageError("the mark DICM of a DICOM file is missing");
  }
  // The meta elements, of group 2, have types and are little-endian; they tell how the rest is.
  Walk meta(std::string_view(bytes).substr(kPreamble));
  std::string syntax;
  while (meta.rest().substr(0, 2) == std::string_view("\2\0", 2)) {
    const Element e = meta.element({});
    if (e.tag == kTransferSyntax) {
      syntax = std::string(meta.take(e.length));
      while (!syntax.empty() && (syntax.back() == '\0' || syntax.back() == ' ')) syntax.pop_back();
    } else {
      meta.skip_value(e, {}, 0);
    }
  }
  if (syntax.empty()) throw ImageError("it does not tell its transfer syntax; it is truncated");
  if (syntax == "1.2.840.10008.1.2.1.99") return find_pixels(inflated(meta.rest()), {});
  return find_pixels(meta.rest(), {syntax != "1.2.840.10008.1.2", syntax == "1.2.840.10008.1.2.2"});
}

bool has_dicom_mark(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 132> start{};
  file.read(start.data(), start.size());
  return file.gcount() == 132 && std::string_view(start.data() + 128, 4) == "DICM";
}

}  // namespace dsc::detail
