#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/mesh_target.h"

namespace dsc::fuzz {

void fuzz_stl(std::string_view bytes) { check_mesh_reader(".stl", bytes); }

}  // namespace dsc::fuzz
