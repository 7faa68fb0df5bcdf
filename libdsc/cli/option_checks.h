/// \file
/// What makes sense together on the command line, beyond what each option checks for itself.
#pragma once

#include "libdsc/cli/options.h"

namespace dsc::cli {

/// \throws UsageError naming the options and what to do; OutputError where a file cannot be
/// written.
void check_options(const Options& options);

}  // namespace dsc::cli
