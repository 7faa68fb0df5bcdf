#include "libdsc/io/ply_values.h"

#include "libdsc/io/byte_blocks.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace dsc::detail {
namespace {

class TextValues final : public PlyValues {
 public:
  TextValues(TextLines& lines, Index size) : lines_(lines), size_(size) {}

  Index room_for(const PlyElement& element) const override {
    const auto values = static_cast<Index>(element.properties.size());
    if (values == 0) return std::numeric_limits<Index>::max();
    return (size_ - lines_.position() + 1) / (2 * values);  // a digit and a blank each
  }
  void begin(const std::string& name, Index number) override {
    do {
      if (!lines_.next()) {
        lines_.fail("the file ends before " + name + " " + std::to_string(number) +
                    "; it is truncated");
      }
    } while (!lines_.more());
  }
  double next(PlyType type) override {
    const double value = lines_.real("a value");
    if (is_integer(type) && value != std::floor(value)) lines_.fail("an integer is expected");
    return value;
  }
  void skip_list(Index items, PlyType type) override {
    for (Index i = 0; i < items; ++i) (void)next(type);
  }
  void end() override {
    if (lines_.more()) lines_.fail("the line goes on after its last value");
  }
  void finish() override {
    while (lines_.next()) {
      if (lines_.more()) lines_.fail("the file goes on after its last element");
    }
  }
  [[noreturn]] void fail(const std::string& why) const override { lines_.fail(why); }

 private:
  TextLines& lines_;
  Index size_;
};

class BinaryValues final : public PlyValues {
 public:
  BinaryValues(InputFile& file, bool swap, std::function<void(Index)> on_read)
      : file_(file), blocks_(file, std::move(on_read)), swap_(swap) {}

  Index room_for(const PlyElement& element) const override {
    Index bytes = 0;
    for (const PlyProperty& p : element.properties) bytes += bytes_of(p.count.value_or(p.type));
    return bytes == 0 ? std::numeric_limits<Index>::max() : blocks_.remaining() / bytes;
  }
  void begin(const std::string& name, Index number) override {
    name_ = &name;
    number_ = number;
    at_ = blocks_.position();
  }
  double next(PlyType type) override {
    const Index bytes = bytes_of(type);
    at_ = blocks_.position();
    if (blocks_.remaining() < bytes) fail("the file ends here; it is truncated");
    unsigned char value[8];
    std::memcpy(value, blocks_.take(bytes), static_cast<std::size_t>(bytes));
    if (swap_) std::reverse(value, value + bytes);
    switch (type) {
      case PlyType::int8:
        return as<std::int8_t>(value);
      case PlyType::uint8:
        return as<std::uint8_t>(value);
      case PlyType::int16:
        return as<std::int16_t>(value);
      case PlyType::uint16:
        return as<std::uint16_t>(value);
      case PlyType::int32:
        return as<std::int32_t>(value);
      case PlyType::uint32:
        return as<std::uint32_t>(value);
      case PlyType::float32:
        return static_cast<double>(as<float>(value));
      case PlyType::float64:
        return as<double>(value);
    }
    return 0;
  }
  void skip_list(Index items, PlyType type) override {
    if (items > blocks_.remaining() / bytes_of(type)) {
      fail("a list of " + std::to_string(items) + " items goes beyond the end of the file");
    }
    blocks_.skip(items * bytes_of(type));
  }
  void end() override {}
  void finish() override {
    if (blocks_.remaining() > 0) {
      file_.fail(blocks_.position(), "the file goes on for " + std::to_string(blocks_.remaining()) +
                                         " bytes after its last element; are the counts right?");
    }
  }
  [[noreturn]] void fail(const std::string& why) const override {
    file_.fail(at_, *name_ + " " + std::to_string(number_) + ": " + why);
  }

 private:
  template <class T>
  static T as(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
  }

  InputFile& file_;
  ByteBlocks blocks_;
  bool swap_;
  const std::string* name_ = nullptr;
  Index number_ = 0;
  Index at_ = 0;
};

}  // namespace

Index PlyValues::length(PlyType type) {
  const double n = next(type);
  if (n < 0) fail("a list has a negative length");
  if (n > 4294967295.) fail("a list's length is beyond 32 bits");
  return static_cast<Index>(n);
}

std::unique_ptr<PlyValues> open_ply_values(PlyEncoding encoding, InputFile& file, TextLines& lines,
                                           const std::function<void(Index)>& on_read) {
  if (encoding == PlyEncoding::text) return std::make_unique<TextValues>(lines, file.size());
  file.seek(lines.position());
  return std::make_unique<BinaryValues>(file, encoding == PlyEncoding::big_endian, on_read);
}

}  // namespace dsc::detail
