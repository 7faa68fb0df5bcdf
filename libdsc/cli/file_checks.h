/// \file
/// The files of a command line, before anything is computed: none is the input, none is written
/// twice, all can be written.
#pragma once

#include "libdsc/cli/options.h"

namespace dsc::cli {

/// Files are compared as the system sees them, so that links, "./" and the like hide nothing.
/// \throws UsageError where an output or the report is the input, lies over a file of an input
/// folder, or is named twice; OutputError as check_writable() does.
void check_files(const Options& options);

/// Whether a result goes to standard output, which then has nothing else.
bool to_standard_output(const Options& options);

}  // namespace dsc::cli
