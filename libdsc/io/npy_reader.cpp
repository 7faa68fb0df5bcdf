// .npy: see volume_source.h for what is read, and NumPy's NEP 1 for the format: the magic bytes
// \x93NUMPY, a version (two bytes), the length of the header (2 bytes little-endian in version 1, 4
// later), a Python dictionary of descr, fortran_order and shape, then the values.
#include "libdsc/base/error.h"
#include "libdsc/io/data_size.h"
#include "libdsc/io/volume_formats.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <string_view>
#include <utility>
#include <vector>

namespace dsc::detail {
namespace {

struct NpyHeader {
  std::string descr;
  bool fortran = false;
  std::vector<Index> shape;
};

/// Parses the one form of dictionary that NumPy writes, in any order of its keys.
class DictionaryParser {
 public:
  DictionaryParser(const InputFile& file, std::string_view text, Index offset)
      : file_(file), text_(text), offset_(offset) {}

  NpyHeader parse() {
    NpyHeader header;
    bool seen[3] = {false, false, false};
    expect('{');
    while (!accept('}')) {
      const std::string key = string();
      expect(':');
      const int which = key == "descr" ? 0 : key == "fortran_order" ? 1 : key == "shape" ? 2 : -1;
      if (which < 0) fail("the key '" + key + "' is unknown");
      if (seen[which]) fail("the key '" + key + "' is given twice");
      seen[which] = true;
      if (which == 0) {
        if (peek() != '\'' && peek() != '"') fail("records are not supported, only plain integers");
        header.descr = string();
      } else if (which == 1) {
        header.fortran = boolean();
      } else {
        header.shape = tuple();
      }
      if (!accept(',')) {
        expect('}');
        break;
      }
    }
    if (peek() != '\0') fail("there is text after the header's dictionary");
    if (!(seen[0] && seen[1] && seen[2])) {
      fail("the header must have the keys descr, fortran_order and shape");
    }
    return header;
  }

 private:
  char peek() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool accept(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!accept(c)) fail(std::string("'") + c + "' is expected");
  }
  std::string string() {
    const char quote = peek();
    if (quote != '\'' && quote != '"') fail("a string is expected");
    const std::size_t end = text_.find(quote, at_ + 1);
    if (end == std::string_view::npos) fail("a string has no end");
    const std::string value(text_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
    return value;
  }
  bool boolean() {
    (void)peek();
    for (const bool value : {true, false}) {
      const std::string_view word = value ? "True" : "False";
      if (text_.substr(at_, word.size()) == word) {
        at_ += word.size();
        return value;
      }
    }
    fail("True or False is expected");
  }
  std::vector<Index> tuple() {
    std::vector<Index> values;
    expect('(');
    while (!accept(')')) {
      (void)peek();
      Index value = 0;
      const char* end = text_.data() + text_.size();
      const auto [stop, error] = std::from_chars(text_.data() + at_, end, value);
      if (error != std::errc{} || value < 0) fail("the shape must consist of 64-bit integers");
      at_ = static_cast<std::size_t>(stop - text_.data());
      values.push_back(value);
      if (!accept(',')) {
        expect(')');
        break;
      }
    }
    return values;
  }
  [[noreturn]] void fail(const std::string& why) const {
    file_.fail(offset_ + static_cast<Index>(at_), "header: " + why + "; is this a .npy file?");
  }

  const InputFile& file_;
  std::string_view text_;
  Index offset_;
  std::size_t at_ = 0;
};

class NpySource final : public VolumeSource {
 public:
  explicit NpySource(InputFile file) : file_(std::move(file)) {
    unsigned char start[8];
    if (file_.size() < 10) file_.fail(file_.size(), "the file is too short for a .npy header");
    file_.read(start, 8);
    if (std::string_view(reinterpret_cast<const char*>(start), 6) != "\x93NUMPY") {
      file_.fail(0, "the magic bytes of a .npy file are missing");
    }
    if (start[6] < 1 || start[6] > 3 || start[7] != 0) {
      file_.fail(6, "version " + std::to_string(start[6]) + "." + std::to_string(start[7]) +
                        " is unknown; 1.0, 2.0 and 3.0 are read");
    }
    unsigned char raw[4] = {0, 0, 0, 0};
    file_.read(raw, start[6] == 1 ? 2 : 4);
    const Index length = raw[0] | raw[1] << 8 | raw[2] << 16 | static_cast<Index>(raw[3]) << 24;
    if (length > file_.remaining() || length > (Index{1} << 20)) {
      file_.fail(8, "a header of " + std::to_string(length) + " bytes does not fit the file");
    }
    const Index offset = file_.position();
    std::string text(static_cast<std::size_t>(length), '\0');
    file_.read(text.data(), length);
    const NpyHeader header = DictionaryParser(file_, text, offset).parse();
    read_type(header.descr, offset);
    read_grid(header, offset);
  }

  const std::string& path() const override { return file_.path(); }
  const Grid& grid() const override { return grid_; }
  bool x_fastest() const override { return !fortran_; }

  void read(const std::function<void(const Slab&)>& take, const Context& context) override {
    const Index slices = fortran_ ? grid_.size[0] : grid_.size[2];
    const Index per_slice = grid_.size[1] * (fortran_ ? grid_.size[2] : grid_.size[0]);
    stream_slabs(
        slices, per_slice, type_, [&](void* to, Index bytes) { file_.read(to, bytes); }, take,
        context);
  }

 private:
  void read_type(const std::string& descr, Index offset) {
    const char order = descr.size() == 3 ? descr[0] : '?';
    const char kind = descr.size() == 3 ? descr[1] : '?';
    const int bytes = descr.size() == 3 ? descr[2] - '0' : 0;
    const bool integer =
        (kind == 'i' || kind == 'u') && (bytes == 1 || bytes == 2 || bytes == 4 || bytes == 8);
    const bool floating = kind == 'f' && (bytes == 4 || bytes == 8);
    const bool known_order =
        order == '<' || order == '>' || order == '=' || (order == '|' && bytes == 1);
    if (!known_order || !(integer || floating || (kind == 'b' && bytes == 1))) {
      file_.fail(offset, "values of type '" + descr +
                             "' are not supported; save integers, bool, float32 or float64");
    }
    const bool little = std::endian::native == std::endian::little;
    type_ = {bytes, kind == 'i', floating, bytes > 1 && order == (little ? '>' : '<')};
  }

  void read_grid(const NpyHeader& header, Index offset) {
    if (header.shape.size() != 3) {
      file_.fail(offset, "the array has " + std::to_string(header.shape.size()) +
                             " dimensions; a volume has 3, indexed [z][y][x]");
    }
    fortran_ = header.fortran;
    grid_.size = {header.shape[2], header.shape[1], header.shape[0]};
    for (const Index size : grid_.size) {
      if (size == 0) file_.fail(offset, "the array is empty");
    }
    const Index bytes = data_bytes(file_, offset, grid_, type_.bytes);
    const Index left = file_.remaining();
    if (left != bytes) {
      file_.fail(file_.size(), "the header promises " + std::to_string(bytes) +
                                   " bytes of data, the file holds " + std::to_string(left) +
                                   (left < bytes ? "; it is truncated" : "; it is too long"));
    }
  }

  InputFile file_;
  Grid grid_;
  ValueType type_;
  bool fortran_ = false;
};

}  // namespace

std::unique_ptr<VolumeSource> open_npy(InputFile file) {
  return std::make_unique<NpySource>(std::move(file));
}

}  // namespace dsc::detail
