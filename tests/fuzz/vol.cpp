#include "libdsc/io/volume_formats.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/volume_target.h"

namespace dsc::fuzz {

void fuzz_vol(std::string_view bytes) {
  const auto open = [](std::string_view file) {
    return detail::open_vol(InputFile("fuzz.vol", file), false);
  };
  check_volume_reader([&] { return open(bytes); }, ".vol", open);
}

}  // namespace dsc::fuzz
