#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/mesh_target.h"

namespace dsc::fuzz {

void fuzz_ply(std::string_view bytes) { check_mesh_reader(".ply", bytes); }

}  // namespace dsc::fuzz
