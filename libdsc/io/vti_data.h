/// \file
/// \internal
/// The values of a .vti file's array, whatever they are wrapped in. Private to io/.
///
/// Bytes are raw or base64. Before the values stands their number of bytes, as one word; where they
/// are compressed, the number of blocks, the size of each but the last, the size of the last (0:
/// like the others) and the compressed size of each, then the blocks, each a zlib stream.
#pragma once

#include "libdsc/io/vti_header.h"

#include <vector>

namespace dsc::detail {

class VtiData {
 public:
  /// From header.begin on; `bytes` is the size of all values.
  VtiData(InputFile& file, const VtiHeader& header, Index bytes);

  /// The next `bytes` bytes of the values. \throws InputError where the file does not have them.
  void next(void* to, Index bytes);
  /// After all values. \throws InputError where there are more.
  void finish();

 private:
  void begin();
  std::vector<std::uint64_t> words(Index count);
  void begin_blocks();
  void next_block();
  void decoded(unsigned char* to, Index bytes);
  void number(unsigned char* to);
  char next_char();
  bool next_group();

  InputFile& file_;
  const VtiHeader header_;
  const Index bytes_;
  bool begun_ = false;

  std::vector<char> text_;  ///< of base64 and ascii, read ahead
  std::size_t text_at_ = 0;
  unsigned char group_[3] = {0, 0, 0};  ///< of four characters
  int group_at_ = 0, group_end_ = 0;

  std::vector<std::uint64_t> compressed_sizes_;
  std::size_t block_ = 0;
  Index block_bytes_ = 0, last_bytes_ = 0;
  std::vector<unsigned char> inflated_;
  Index inflated_at_ = 0;
};

}  // namespace dsc::detail
