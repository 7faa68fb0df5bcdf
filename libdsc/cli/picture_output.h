/// \file
/// Results as pictures.
#pragma once

#include "libdsc/cli/stages.h"

namespace dsc::cli {

/// Draws one field of a result, or its labels, or the surface alone, and writes it as PNG. `placed`
/// is `result` in the world, with the labels as fields.
void write_picture(const std::string& path, const Scene& scene, const Result& result,
                   const Result& placed, Run& run);

}  // namespace dsc::cli
