/// \file
/// \internal
/// The bytes of a file one record after another, read in blocks.
#pragma once

#include "libdsc/io/input_file.h"

#include <functional>
#include <vector>

namespace dsc::detail {

class ByteBlocks {
 public:
  /// From the file's position on. `on_read` is called with the number of bytes of each block.
  explicit ByteBlocks(InputFile& file, std::function<void(Index)> on_read = {})
      : file_(file), on_read_(std::move(on_read)) {}

  /// The byte that the next take() begins with.
  Index position() const { return file_.position() - static_cast<Index>(end_ - begin_); }
  /// Bytes of the file after it.
  Index remaining() const { return file_.size() - position(); }

  /// The next `bytes` bytes; the pointer lives until the next call. The caller has checked that
  /// remaining() is not less.
  const unsigned char* take(Index bytes) {
    const auto count = static_cast<std::size_t>(bytes);
    if (end_ - begin_ < count) refill(count);
    begin_ += count;
    return buffer_.data() + begin_ - count;
  }
  /// Drops bytes without reading them.
  void skip(Index bytes) {
    file_.seek(position() + bytes);
    begin_ = end_ = 0;
  }

 private:
  void refill(std::size_t count);

  InputFile& file_;
  std::function<void(Index)> on_read_;
  std::vector<unsigned char> buffer_;
  std::size_t begin_ = 0, end_ = 0;
};

}  // namespace dsc::detail
