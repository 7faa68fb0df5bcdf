/// \file
/// What makes sense together on the command line, beyond what each option checks for itself.
#pragma once

#include "libdsc/cli/options.h"

namespace dsc::cli {

/// \throws UsageError naming the options and what to do; OutputError where a file's folder is
/// missing.
void check_options(const Options& options);

}  // namespace dsc::cli
