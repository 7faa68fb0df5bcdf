/// \file
/// \internal
/// A text file line by line, and the words and numbers of a line.
#pragma once

#include "libdsc/io/input_file.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace dsc::detail {

/// Lines end in \n or \r\n; the last one need not end. The file is read in blocks, and a view of a
/// line lives until the next one.
class TextLines {
 public:
  /// `on_read` is called with the number of bytes of each block.
  explicit TextLines(InputFile& file, std::function<void(Index)> on_read = {});

  /// Moves to the next line. \return false at the end of the file. \throws InputError where the
  /// line is longer than 16 MiB, as binary data would be.
  bool next();
  /// Moves to the next line that has more than blanks and a comment from `#` on, and drops these.
  bool next_with_content();

  std::string_view line() const { return line_; }
  Index number() const { return number_; }      ///< of the line, from 1
  Index position() const { return position_; }  ///< the byte where the next line begins

  /// The next word of the line; empty at its end.
  std::string_view word();
  /// Whether the line has another word.
  bool more();
  /// The rest of the line from the next word on.
  std::string_view rest();
  /// Replaces the line's text (joined lines), its number unchanged.
  void set_line(std::string_view line);
  /// Drops the rest of the line from this byte on.
  void drop_comment(std::size_t from);

  /// From now on a number is refused where the file ends on it without a newline: it may have been
  /// cut off. Until then it is taken as whole, as many programs end their files so.
  void refuse_unended_number() { refuses_unended_ = true; }
  /// Adds a sentence where such a number was taken.
  void remark_unended_number(std::vector<std::string>& remarks) const;

  /// The next word as a number. \throws InputError, calling it `what`, where there is none, it is
  /// something else, or the file ends on it and refuse_unended_number() was called.
  double real(const char* what);
  /// The same, and finite.
  double finite(const char* what);
  Index integer(const char* what);
  /// `word`, one of this line's, as an integer.
  Index integer(std::string_view word, const char* what);

  /// \throws InputError "PATH, line N: why".
  [[noreturn]] void fail(const std::string& why) const;

 private:
  std::string_view number_word(const char* what);
  void check_unended(std::string_view word);

  InputFile& file_;
  std::function<void(Index)> on_read_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< what of the buffer is not yet consumed
  std::string_view line_;
  std::string_view left_;  ///< of the line
  bool ended_ = true;      ///< by a newline
  bool refuses_unended_ = false;
  std::string unended_;  ///< the number on which the file ended
  Index number_ = 0;
  Index position_ = 0;
};

}  // namespace dsc::detail
