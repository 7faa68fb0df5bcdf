#include "libdsc/io/volume_formats.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/volume_target.h"

#include <array>
#include <cstring>

namespace dsc::fuzz {

/// The first ten bytes are the layout: three sizes of 16 bits, of which the highest two bits shift
/// them up to sizes that cannot be; the type; the byte order; the offset, of 16 bits.
void fuzz_raw(std::string_view bytes) {
  constexpr std::array<const char*, 10> kTypes{"u8",  "i8",  "u16", "i16", "u32",
                                               "i32", "u64", "i64", "f32", "f64"};
  constexpr std::size_t kLayout = 10;
  if (bytes.size() < kLayout) return;
  RawLayout layout;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::uint16_t size = 0;
    std::memcpy(&size, bytes.data() + 2 * axis, sizeof size);
    layout.size[axis] = static_cast<Index>(size & 0x3fff) << 16 * (size >> 14);
  }
  layout.type = value_type(kTypes[static_cast<unsigned char>(bytes[6]) % kTypes.size()]);
  layout.big_endian = (bytes[7] & 1) != 0;
  std::int16_t offset = 0;
  std::memcpy(&offset, bytes.data() + 8, sizeof offset);
  layout.offset = offset;
  const std::string_view file = bytes.substr(kLayout);
  check_volume_reader(
      [&] { return detail::open_raw(InputFile("fuzz.raw", file), layout); }, ".npy",
      [](std::string_view written) { return detail::open_npy(InputFile("fuzz.npy", written)); });
}

}  // namespace dsc::fuzz
