/// \file
/// What every reader of meshes has to keep.
#pragma once

#include <string>
#include <string_view>

namespace dsc::fuzz {

/// Reads the bytes as `fuzz<ending>`, checks the mesh, writes it and reads it again.
/// \throws Broken; dsc::Error where the bytes are refused.
void check_mesh_reader(const std::string& ending, std::string_view bytes);

}  // namespace dsc::fuzz
