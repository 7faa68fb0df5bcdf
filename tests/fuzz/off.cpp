#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/mesh_target.h"

namespace dsc::fuzz {

void fuzz_off(std::string_view bytes) { check_mesh_reader(".off", bytes); }

}  // namespace dsc::fuzz
