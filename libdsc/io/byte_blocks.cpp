#include "libdsc/io/byte_blocks.h"

#include <algorithm>

namespace dsc::detail {

void ByteBlocks::refill(std::size_t count) {
  constexpr std::size_t kBlock = std::size_t{1} << 18;
  const std::size_t left = end_ - begin_;
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
            buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
  const std::size_t wanted = std::min<std::size_t>(
      std::max(kBlock, count), left + static_cast<std::size_t>(file_.remaining()));
  if (buffer_.size() < wanted) buffer_.resize(wanted);
  const std::size_t fresh = std::max(wanted, count) - left;
  file_.read(buffer_.data() + left, static_cast<Index>(fresh));
  if (on_read_) on_read_(static_cast<Index>(fresh));
  begin_ = 0;
  end_ = left + fresh;
}

}  // namespace dsc::detail
