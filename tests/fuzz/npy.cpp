#include "libdsc/io/volume_formats.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/volume_target.h"

namespace dsc::fuzz {

void fuzz_npy(std::string_view bytes) {
  const auto open = [](std::string_view file) {
    return detail::open_npy(InputFile("fuzz.npy", file));
  };
  check_volume_reader([&] { return open(bytes); }, ".npy", open);
}

}  // namespace dsc::fuzz
