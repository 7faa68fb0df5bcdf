#include "libdsc/io/volume_formats.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/volume_target.h"

namespace dsc::fuzz {

void fuzz_vti(std::string_view bytes) {
  const auto open = [](std::string_view file) {
    return detail::open_vti(InputFile("fuzz.vti", file));
  };
  check_volume_reader([&] { return open(bytes); }, ".vti", open);
}

}  // namespace dsc::fuzz
