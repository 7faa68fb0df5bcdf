/// \file
/// \internal
/// A program that writes to a pipe, started and read.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/base/types.h"

#include <string>
#include <vector>

#include <sys/types.h>

namespace dsc::detail {

class ChildProcess {
 public:
  /// Starts the program at `path` (not looked for in PATH) with these arguments, nothing on its
  /// standard input. \throws InputError where it cannot be started.
  ChildProcess(const std::string& path, const std::vector<std::string>& arguments);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  /// Kills it where it still runs.
  ~ChildProcess();

  /// Kills every child that is still there, for the end of the process: a child whose parent is
  /// gone might go on for ever. Only calls what a signal handler may.
  static void kill_all() noexcept;

  /// The next bytes of its standard output, at most `bytes`; fewer only where the output ends.
  /// \throws Cancelled within about a tenth of a second.
  Index read(void* to, Index bytes, const Context& context);

  /// Waits for its end. \return "" where it exited with 0, else why not: the last line that it
  /// wrote to standard error, or the signal that ended it.
  std::string finish(const Context& context);

 private:
  /// Waits until there is output, keeping what comes on standard error. \return false where nothing
  /// came in time.
  bool wait_for_output();
  void keep_errors();

  pid_t pid_ = -1;
  int output_ = -1;
  int errors_ = -1;
  std::string error_text_;  ///< its end
};

}  // namespace dsc::detail
