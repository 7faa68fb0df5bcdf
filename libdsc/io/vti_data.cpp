#include "libdsc/io/vti_data.h"

#include "libdsc/base/checked.h"
#include "libdsc/base/error.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <string_view>

namespace dsc::detail {
namespace {

constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr Index kMostDeflated = 1032;  // of zlib: bytes that one byte can become

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

}  // namespace

VtiData::VtiData(InputFile& file, const VtiHeader& header, Index bytes)
    : file_(file), header_(header), bytes_(bytes) {
  file_.seek(header_.begin);
}

void VtiData::next(void* to, Index bytes) {
  auto* target = static_cast<unsigned char*>(to);
  if (header_.encoding == VtiEncoding::ascii) {
    for (Index at = 0; at < bytes; at += header_.type.bytes) number(target + at);
    return;
  }
  if (!begun_) begin();
  if (!header_.compressed) return decoded(target, bytes);
  while (bytes > 0) {
    if (inflated_at_ == static_cast<Index>(inflated_.size())) next_block();
    const Index some = std::min(bytes, static_cast<Index>(inflated_.size()) - inflated_at_);
    std::memcpy(target, inflated_.data() + inflated_at_, static_cast<std::size_t>(some));
    inflated_at_ += some;
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
  std::vector<std::uint64_t> result(static_cast<std::size_t>(count));
  for (std::uint64_t& word : result) {
    unsigned char raw[8] = {};
    decoded(raw, header_.word_bytes);
    if (header_.swap_words) std::reverse(raw, raw + header_.word_bytes);
    std::memcpy(&word, raw, sizeof word);  // libdsc runs on little-endian machines only
  }
  return result;
}

void VtiData::begin_blocks() {
  const std::vector<std::uint64_t> sizes = words(3);
  const auto left = static_cast<std::uint64_t>(file_.size() - header_.begin);
  const std::uint64_t blocks = sizes[0], full = sizes[1], last = sizes[2];
  // Each block takes a word here, and makes no more than kMostDeflated times its bytes.
  const bool sane =
      blocks <= left && full <= kMostDeflated * left && last <= full && (blocks == 0 || full > 0);
  const std::uint64_t total =
      !sane || blocks == 0 ? 0 : (blocks - (last > 0 ? 1 : 0)) * full + last;
  if (!sane || total != static_cast<std::uint64_t>(bytes_)) {
    file_.fail(header_.begin, "the blocks do not make the " + std::to_string(bytes_) +
                                  " bytes of the image's extent and type");
  }
  block_bytes_ = static_cast<Index>(full);
  last_bytes_ = static_cast<Index>(last > 0 ? last : full);
  compressed_sizes_ = words(static_cast<Index>(blocks));
}

void VtiData::next_block() {
  if (block_ == compressed_sizes_.size()) file_.fail(file_.position(), "the blocks end too early");
  const std::uint64_t packed = compressed_sizes_[block_++];
  const bool last = block_ == compressed_sizes_.size();
  const Index size = last ? last_bytes_ : block_bytes_;
  const auto left = static_cast<std::uint64_t>(file_.size() - header_.begin);
  const std::string which = "block " + std::to_string(block_);
  if (packed > left || size > kMostDeflated * static_cast<Index>(packed)) {
    file_.fail(file_.position(), which + " does not fit the file; it is truncated or damaged");
  }
  std::vector<unsigned char> bytes(static_cast<std::size_t>(packed));
  decoded(bytes.data(), static_cast<Index>(packed));
  inflated_.resize(static_cast<std::size_t>(size));
  auto got = static_cast<uLongf>(size);
  const int code = uncompress(inflated_.data(), &got, bytes.data(), static_cast<uLong>(packed));
  if (code != Z_OK || got != static_cast<uLongf>(size)) {
    file_.fail(file_.position(), which + " before here is damaged");
  }
  inflated_at_ = 0;
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
