#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/mesh_target.h"

namespace dsc::fuzz {

void fuzz_obj(std::string_view bytes) { check_mesh_reader(".obj", bytes); }

}  // namespace dsc::fuzz
