#include "libdsc/io/vti_data.h"

#include "libdsc/base/error.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <string_view>

#include <zlib.h>

namespace dsc::detail {
namespace {

constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr Index kMostDeflated = 1032;     // of zlib: bytes that one byte can become
constexpr Index kPiece = Index{1} << 20;  // between two looks at the monitor; whole values

bool is_xml_space(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

/// Writes the number that `text` is as a T. \return whether it is one.
template <class T>
bool parse(std::string_view text, unsigned char* to) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  std::memcpy(to, &value, sizeof value);
  return error == std::errc{} && end == text.data() + text.size();
}

bool parse(std::string_view text, const ValueType& type, unsigned char* to) {
  if (type.is_float) return type.bytes == 4 ? parse<float>(text, to) : parse<double>(text, to);
  switch (type.bytes) {
    case 1:
      return type.is_signed ? parse<std::int8_t>(text, to) : parse<std::uint8_t>(text, to);
    case 2:
      return type.is_signed ? parse<std::int16_t>(text, to) : parse<std::uint16_t>(text, to);
    case 4:
      return type.is_signed ? parse<std::int32_t>(text, to) : parse<std::uint32_t>(text, to);
    default:
      return type.is_signed ? parse<std::int64_t>(text, to) : parse<std::uint64_t>(text, to);
  }
}

/// The most bytes that there can be from the beginning of the array on.
Index room(const InputFile& file, const VtiHeader& header) {
  const Index left = file.size() - header.begin;
  return header.encoding == VtiEncoding::raw ? left : left / 4 * 3;
}

void end_stream(z_stream_s* stream) {
  (void)inflateEnd(stream);
  delete stream;
}

}  // namespace

void check_vti_room(const InputFile& file, const VtiHeader& header, Index bytes) {
  bool fits = true;
  if (header.encoding == VtiEncoding::ascii) {  // a digit and what parts it from the next
    fits = bytes / header.type.bytes <= (file.size() - header.begin + 1) / 2;
  } else {
    fits = (header.compressed ? bytes / kMostDeflated : bytes) <= room(file, header);
  }
  if (!fits) {
    file.fail(file.size(), "the image's extent and type make " + std::to_string(bytes) +
                               " bytes, more than the file can hold; it is truncated or damaged");
  }
}

VtiData::VtiData(InputFile& file, const VtiHeader& header, Index bytes, const Context& context)
    : file_(file),
      header_(header),
      bytes_(bytes),
      context_(context),
      stream_(nullptr, &end_stream) {
  if (header_.compressed) {
    auto stream = std::make_unique<z_stream>();
    if (inflateInit(stream.get()) != Z_OK) throw LimitError("zlib: no memory to inflate");
    stream_.reset(stream.release());
  }
  file_.seek(header_.begin);
}

void VtiData::next(void* to, Index bytes) {
  auto* target = static_cast<unsigned char*>(to);
  while (bytes > 0) {
    context_.check();
    Index some = std::min(bytes, kPiece);
    if (header_.encoding == VtiEncoding::ascii) {
      for (Index at = 0; at < some; at += header_.type.bytes) number(target + at);
    } else {
      if (!begun_) begin();
      if (header_.compressed) {
        if (block_left_ == 0) next_block();
        some = std::min(some, block_left_);
        inflated(target, some);
      } else {
        decoded(target, some);
      }
    }
    target += some;
    bytes -= some;
  }
}

void VtiData::finish() {
  if (header_.encoding != VtiEncoding::ascii) return;  // sizes have told how much there is
  char c = next_char();
  while (is_xml_space(c)) c = next_char();
  if (c != '<') file_.fail(file_.position(), "the array has more numbers than the image's extent");
}

void VtiData::begin() {
  begun_ = true;
  if (header_.compressed) return begin_blocks();
  const auto promised = static_cast<Index>(words(1)[0]);
  if (promised != bytes_) {
    file_.fail(header_.begin, "the array has " + std::to_string(promised) +
                                  " bytes, but the image's extent and type make " +
                                  std::to_string(bytes_));
  }
}

std::vector<std::uint64_t> VtiData::words(Index count) {
  constexpr Index kAtOnce = 1024;
  unsigned char raw[8 * kAtOnce];
  std::vector<std::uint64_t> result(static_cast<std::size_t>(count));
  for (Index first = 0; first < count; first += kAtOnce) {
    if (first > 0) context_.check();
    const Index some = std::min(kAtOnce, count - first);
    decoded(raw, some * header_.word_bytes);
    for (Index i = 0; i < some; ++i) {
      unsigned char word[8] = {};
      std::memcpy(word, raw + i * header_.word_bytes, static_cast<std::size_t>(header_.word_bytes));
      if (header_.swap_words) std::reverse(word, word + header_.word_bytes);
      // libdsc runs on little-endian machines only.
      std::memcpy(&result[static_cast<std::size_t>(first + i)], word, sizeof word);
    }
  }
  return result;
}

void VtiData::begin_blocks() {
  const std::vector<std::uint64_t> sizes = words(3);
  const std::uint64_t blocks = sizes[0], full = sizes[1];
  const std::uint64_t last = sizes[2] == full ? 0 : sizes[2];
  const auto bytes = static_cast<std::uint64_t>(bytes_);
  // Division instead of products, which the sizes of a damaged file may overflow.
  if (full == 0 || bytes % full != last || bytes / full != blocks - (last > 0 ? 1 : 0)) {
    file_.fail(header_.begin, "the blocks do not make the " + std::to_string(bytes_) +
                                  " bytes of the image's extent and type");
  }
  block_bytes_ = static_cast<Index>(std::min(full, bytes));
  const auto word = static_cast<std::uint64_t>(header_.word_bytes);
  auto left = static_cast<std::uint64_t>(room(file_, header_));
  if (blocks > left / word - 3) {  // three were there
    file_.fail(header_.begin, "the sizes of " + std::to_string(blocks) +
                                  " blocks do not fit the file; it is truncated or damaged");
  }
  context_.need("read", static_cast<Index>(blocks * sizeof(std::uint64_t)));
  compressed_sizes_ = words(static_cast<Index>(blocks));
  left -= (3 + blocks) * word;
  for (std::uint64_t i = 0; i < blocks; ++i) {
    const std::uint64_t packed = compressed_sizes_[i];
    const std::uint64_t size = last > 0 && i + 1 == blocks ? last : full;
    if (packed > left || size / static_cast<std::uint64_t>(kMostDeflated) > packed) {
      file_.fail(header_.begin, "block " + std::to_string(i + 1) +
                                    " does not fit the file; it is truncated or damaged");
    }
    left -= packed;
  }
  packed_.resize(std::size_t{1} << 16);
}

void VtiData::next_block() {
  packed_left_ = static_cast<Index>(compressed_sizes_[block_++]);
  block_left_ = std::min(block_bytes_, bytes_ - begun_bytes_);
  begun_bytes_ += block_left_;
  (void)inflateReset(stream_.get());
}

/// \pre no more than is left of the block.
void VtiData::inflated(unsigned char* to, Index bytes) {
  stream_->next_out = to;
  stream_->avail_out = static_cast<uInt>(bytes);
  while (stream_->avail_out > 0) {
    if (inflate_step() && stream_->avail_out > 0) block_is_damaged();
  }
  block_left_ -= bytes;
  if (block_left_ > 0) return;
  // The stream and its checksum must end here too.
  Bytef beyond = 0;
  stream_->next_out = &beyond;
  stream_->avail_out = 1;
  while (!inflate_step()) {
  }
  if (stream_->avail_out == 0 || stream_->avail_in > 0 || packed_left_ > 0) block_is_damaged();
}

/// \return whether the stream has ended.
bool VtiData::inflate_step() {
  if (stream_->avail_in == 0) {
    const Index some = std::min(packed_left_, static_cast<Index>(packed_.size()));
    decoded(packed_.data(), some);
    packed_left_ -= some;
    stream_->next_in = packed_.data();
    stream_->avail_in = static_cast<uInt>(some);
  }
  const int code = inflate(stream_.get(), Z_NO_FLUSH);
  if (code == Z_MEM_ERROR) throw LimitError("zlib: no memory to inflate");
  if (code != Z_OK && code != Z_STREAM_END) block_is_damaged();
  return code == Z_STREAM_END;
}

void VtiData::block_is_damaged() const {
  file_.fail(file_.position(), "block " + std::to_string(block_) + " before here is damaged");
}

void VtiData::decoded(unsigned char* to, Index bytes) {
  if (header_.encoding == VtiEncoding::raw) return file_.read(to, bytes);
  for (Index i = 0; i < bytes; ++i) {
    while (group_at_ == group_end_) {
      if (!next_group()) file_.fail(file_.position(), "the base64 text ends before its data does");
    }
    to[i] = group_[group_at_++];
  }
}

/// The next four characters of base64; padding ends a part, and the next begins anew.
bool VtiData::next_group() {
  unsigned value = 0;
  int padding = 0;
  for (int i = 0; i < 4; ++i) {
    char c = next_char();
    while (is_xml_space(c)) c = next_char();
    if (c == '=' && i >= 2) {
      ++padding;
      value <<= 6;
      continue;
    }
    const std::size_t digit = kDigits.find(c);
    if (c == '\0' || digit == std::string_view::npos || padding > 0) return false;
    value = value << 6 | static_cast<unsigned>(digit);
  }
  for (int i = 0; i < 3; ++i) group_[i] = static_cast<unsigned char>(value >> (16 - 8 * i));
  group_at_ = 0;
  group_end_ = 3 - padding;
  return true;
}

/// '\0' at the end of the file.
char VtiData::next_char() {
  if (text_at_ == text_.size()) {
    text_.resize(std::size_t{1} << 16);
    text_.resize(
        static_cast<std::size_t>(file_.read_some(text_.data(), static_cast<Index>(text_.size()))));
    text_at_ = 0;
    if (text_.empty()) return '\0';
  }
  return text_[text_at_++];
}

void VtiData::number(unsigned char* to) {
  std::string text;
  char c = next_char();
  while (is_xml_space(c)) c = next_char();
  for (; !is_xml_space(c) && c != '<' && c != '\0' && text.size() < 64; c = next_char()) text += c;
  if (c == '<' && text_at_ > 0) --text_at_;  // what comes next asks again and finds nothing
  if (!parse(text, header_.type, to)) {
    file_.fail(file_.position() - static_cast<Index>(text_.size() - text_at_),
               text.empty() ? "the numbers end before the image does"
                            : "'" + text + "' before here is no value of the array's type");
  }
}

}  // namespace dsc::detail
