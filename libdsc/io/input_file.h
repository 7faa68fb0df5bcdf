/// \file
/// \internal
/// A regular file, or bytes in memory, read front to back with errors that name the file and the
/// byte.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/base/types.h"

#include <memory>
#include <string>
#include <string_view>

namespace dsc {

class InputFile {
 public:
  /// Of `FORMAT:-` (standard_stream.h) all of standard input is read into memory at once.
  /// \throws InputError where `path` cannot be opened or is no regular file; LimitError, Cancelled
  /// on the way through standard input.
  explicit InputFile(const std::string& path, const Context& context = {});
  /// The same over `bytes`, which must outlive it; `name` stands for the path.
  InputFile(std::string name, std::string_view bytes);
  InputFile(InputFile&& other) noexcept;
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile();

  const std::string& path() const { return path_; }
  Index size() const { return size_; }          ///< bytes
  Index position() const { return position_; }  ///< of the next byte to be read
  Index remaining() const { return size_ - position_; }

  /// Reads exactly `bytes`. \throws InputError where the file ends before.
  void read(void* to, Index bytes);
  /// Reads at most `bytes`; 0 at the end of the file.
  Index read_some(void* to, Index bytes);
  void seek(Index position);

  /// \throws InputError "PATH, byte AT: why".
  [[noreturn]] void fail(Index at, const std::string& why) const;

 private:
  std::string path_;
  int file_ = -1;                             ///< -1: the bytes are in memory
  std::shared_ptr<const std::string> owned_;  ///< of standard input
  std::string_view bytes_;                    ///< in memory
  Index size_ = 0;
  Index position_ = 0;
};

namespace detail {

/// `text`, which may repeat what a file holds, fit for a terminal and a log: what is not printable
/// ASCII becomes '?', and the middle of more than 600 characters is left out.
std::string printable(std::string text);

}  // namespace detail
}  // namespace dsc
