#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/mesh_target.h"

namespace dsc::fuzz {

void fuzz_om(std::string_view bytes) { check_mesh_reader(".om", bytes); }

}  // namespace dsc::fuzz
