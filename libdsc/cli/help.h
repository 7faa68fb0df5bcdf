/// \file
/// The examples at the end of each help text.
#pragma once

#include "libdsc/cli/options.h"

#include <string>

namespace dsc::cli {

/// What `dsc --help` ends with: shapes, files, exit codes.
std::string help_footer();
/// What `dsc COMMAND --help` ends with: examples.
std::string help_footer(Command command);

/// `text` with its long lines broken at blanks; what follows lines up with the descriptions.
std::string wrapped(const std::string& text);

}  // namespace dsc::cli
