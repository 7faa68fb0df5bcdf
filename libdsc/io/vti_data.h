/// \file
/// \internal
/// The values of a .vti file's array, whatever they are wrapped in. Private to io/.
///
/// Bytes are raw or base64. Before the values stands their number of bytes, as one word; where they
/// are compressed, the number of blocks, the size of each but the last, the size of the last (0:
/// like the others) and the compressed size of each, then the blocks, each a zlib stream. Blocks
/// may be of any size: they are inflated straight to where the values go, and take no memory.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/io/vti_header.h"

#include <memory>
#include <vector>

struct z_stream_s;  // of zlib

namespace dsc::detail {

/// \throws InputError where `file` is too short for `bytes` bytes of values, however well they are
/// compressed.
void check_vti_room(const InputFile& file, const VtiHeader& header, Index bytes);

class VtiData {
 public:
  /// From header.begin on; `bytes` is the size of all values.
  VtiData(InputFile& file, const VtiHeader& header, Index bytes, const Context& context = {});

  /// The next `bytes` bytes of the values. \throws InputError where the file does not have them;
  /// LimitError where memory does not hold the blocks' sizes; Cancelled, within a MiB.
  void next(void* to, Index bytes);
  /// After all values. \throws InputError where there are more.
  void finish();

 private:
  void begin();
  std::vector<std::uint64_t> words(Index count);
  void begin_blocks();
  void next_block();
  void inflated(unsigned char* to, Index bytes);
  bool inflate_step();
  [[noreturn]] void block_is_damaged() const;
  void decoded(unsigned char* to, Index bytes);
  void number(unsigned char* to);
  char next_char();
  bool next_group();

  InputFile& file_;
  const VtiHeader header_;
  const Index bytes_;
  const Context context_;
  bool begun_ = false;

  std::vector<char> text_;  ///< of base64 and ascii, read ahead
  std::size_t text_at_ = 0;
  unsigned char group_[3] = {0, 0, 0};  ///< of four characters
  int group_at_ = 0, group_end_ = 0;

  std::vector<std::uint64_t> compressed_sizes_;
  std::size_t block_ = 0;              ///< the number of those begun
  Index block_bytes_ = 0;              ///< of each but the last, inflated
  Index begun_bytes_ = 0;              ///< of all blocks that are begun, inflated
  Index block_left_ = 0;               ///< bytes of this one that are still to be inflated
  Index packed_left_ = 0;              ///< and to be decoded
  std::vector<unsigned char> packed_;  ///< a part of this block
  std::unique_ptr<z_stream_s, void (*)(z_stream_s*)> stream_;  ///< where compressed
};

}  // namespace dsc::detail
