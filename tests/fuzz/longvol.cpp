#include "libdsc/io/volume_formats.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/volume_target.h"

namespace dsc::fuzz {

void fuzz_longvol(std::string_view bytes) {
  const auto open = [](std::string_view file) {
    return detail::open_vol(InputFile("fuzz.longvol", file), true);
  };
  check_volume_reader([&] { return open(bytes); }, ".longvol", open);
}

}  // namespace dsc::fuzz
