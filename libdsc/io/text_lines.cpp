#include "libdsc/io/text_lines.h"

#include "libdsc/base/error.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

namespace dsc::detail {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 18;
constexpr std::size_t kLongestLine = std::size_t{16} << 20;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

/// A word of the file in a message: what is printable, and not too much of it.
std::string shown(std::string_view word) {
  return "'" + printable(std::string(word.substr(0, 40))) + (word.size() > 40 ? "..." : "") + "'";
}

}  // namespace

TextLines::TextLines(InputFile& file, std::function<void(Index)> on_read)
    : file_(file),
      on_read_(std::move(on_read)),
      buffer_(std::min(kBlock, static_cast<std::size_t>(file.size()) + 1)),
      position_(file.position()) {}

bool TextLines::next() {
  std::size_t seen = 0;
  for (;;) {
    const char* start = buffer_.data() + begin_;
    const auto* end = static_cast<const char*>(
        seen < end_ - begin_ ? std::memchr(start + seen, '\n', end_ - begin_ - seen) : nullptr);
    if (end != nullptr) {
      line_ = {start, static_cast<std::size_t>(end - start)};
      begin_ += line_.size() + 1;
      ended_ = true;
      break;
    }
    seen = end_ - begin_;
    if (seen > kLongestLine) {
      ++number_;
      fail("the line is longer than 16 MiB; is this a text file?");
    }
    if (begin_ > 0) std::memmove(buffer_.data(), start, seen);
    begin_ = 0;
    end_ = seen;
    if (end_ == buffer_.size()) buffer_.resize(2 * buffer_.size());
    const Index count =
        file_.read_some(buffer_.data() + end_, static_cast<Index>(buffer_.size() - end_));
    if (on_read_) on_read_(count);
    end_ += static_cast<std::size_t>(count);
    if (count > 0) continue;
    if (seen == 0) return false;
    line_ = {buffer_.data(), seen};
    begin_ = end_;
    ended_ = false;
    break;
  }
  position_ += static_cast<Index>(line_.size()) + (ended_ ? 1 : 0);
  ++number_;
  if (ended_ && !line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
  left_ = line_;
  return true;
}

bool TextLines::next_with_content() {
  while (next()) {
    const std::size_t comment = line_.find('#');
    if (comment != std::string_view::npos) drop_comment(comment);
    if (more()) return true;
  }
  return false;
}

void TextLines::set_line(std::string_view line) { line_ = left_ = line; }

void TextLines::drop_comment(std::size_t from) {
  set_line(line_.substr(0, from));
  ended_ = true;
}

bool TextLines::more() {
  while (!left_.empty() && is_blank(left_.front())) left_.remove_prefix(1);
  return !left_.empty();
}

std::string_view TextLines::rest() { return more() ? left_ : std::string_view(); }

std::string_view TextLines::word() {
  if (!more()) return {};
  std::size_t length = 0;
  while (length < left_.size() && !is_blank(left_[length])) ++length;
  const std::string_view result = left_.substr(0, length);
  left_.remove_prefix(length);
  return result;
}

void TextLines::check_unended(std::string_view word) {
  if (ended_ || word.data() + word.size() != line_.data() + line_.size()) return;
  if (refuses_unended_) {
    fail("the file ends on the number " + shown(word) +
         ", which may have been cut off; if it is whole, end the line");
  }
  unended_ = shown(word);
}

void TextLines::remark_unended_number(std::vector<std::string>& remarks) const {
  if (unended_.empty()) return;
  remarks.push_back("the file ends without a newline on the number " + unended_ +
                    ", which was taken to be whole");
}

std::string_view TextLines::number_word(const char* what) {
  std::string_view digits = word();
  if (digits.empty()) {
    if (ended_) fail(std::string(what) + " is missing; the line ends before it");
    fail(std::string(what) + " is missing; the file ends before it: it is truncated");
  }
  check_unended(digits);
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  return digits;
}

double TextLines::real(const char* what) {
  const std::string_view digits = number_word(what);
  double value = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  if (error == std::errc::result_out_of_range && stop == end) {
    fail(std::string(what) + ": " + shown(digits) + " is beyond the range of a double");
  }
  if (error != std::errc{} || stop != end) {
    fail(std::string(what) + ": " + shown(digits) + " is not a number");
  }
  return value;
}

double TextLines::finite(const char* what) {
  const double value = real(what);
  if (!std::isfinite(value)) {
    fail(std::string(what) + " is " + (std::isnan(value) ? "not a number" : "infinite") +
         "; repair the vertex or remove it");
  }
  return value;
}

Index TextLines::integer(const char* what) {
  const std::string_view digits = number_word(what);
  return integer(digits, what);
}

Index TextLines::integer(std::string_view digits, const char* what) {
  check_unended(digits);
  Index value = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  if (error != std::errc{} || stop != end) {
    fail(std::string(what) + ": " + shown(digits) + " is not a 64-bit integer");
  }
  return value;
}

void TextLines::fail(const std::string& why) const {
  throw InputError("'" + file_.path() + "', line " + std::to_string(number_) + ": " +
                   printable(why));
}

}  // namespace dsc::detail
