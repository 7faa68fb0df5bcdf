// libFuzzer's way in. What is neither read nor refused by a dsc::Error ends the process.
#include "tests/fuzz/fuzz.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  (void)dsc::fuzz::outcome(dsc::fuzz::DSC_FUZZ_TARGET, {reinterpret_cast<const char*>(data), size});
  return 0;
}
