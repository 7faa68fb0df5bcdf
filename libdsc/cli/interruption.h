/// \file
/// Ctrl-C: an orderly end within a second.
#pragma once

#include "libdsc/base/context.h"

#include <memory>

namespace dsc::cli {

inline constexpr int kInterruptedExitCode = 130;

/// From here on SIGINT and SIGTERM ask `monitor` to stop. If the program is still running a second
/// later (a step of another library cannot be cancelled), or at a second signal, temporary files
/// are removed and the program ends with kInterruptedExitCode. A write beyond the file size limit
/// becomes an ordinary error instead of a signal. Call once, before any other thread exists.
void watch_signals(std::shared_ptr<Monitor> monitor);

}  // namespace dsc::cli
