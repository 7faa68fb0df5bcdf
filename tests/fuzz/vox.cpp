#include "libdsc/io/volume_formats.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/volume_target.h"

namespace dsc::fuzz {

void fuzz_vox(std::string_view bytes) {
  // There is no writer of .vox.
  check_volume_reader(
      [&] { return detail::open_vox(InputFile("fuzz.vox", bytes)); }, ".vol",
      [](std::string_view file) { return detail::open_vol(InputFile("fuzz.vol", file), false); });
}

}  // namespace dsc::fuzz
