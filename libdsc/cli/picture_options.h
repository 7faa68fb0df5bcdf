/// \file
/// The options of .png outputs: how the surface is looked at, coloured and lit.
#pragma once

#include "libdsc/cli/options.h"

#include <CLI/CLI.hpp>

namespace dsc::cli {

/// Whether `path` ends in .png, upper or lower case.
bool is_picture_path(const std::string& path);

void add_picture(CLI::App& app, Options& o);

/// \throws UsageError where one of them is given without a .png output or could change nothing in
/// it, and where this program was built without pictures.
void check_picture_options(const Options& o);

}  // namespace dsc::cli
