/// \file
/// \internal
/// A program that writes to a pipe, started and read.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/base/types.h"

#include <chrono>
#include <string>
#include <utility>
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

  /// It is given up, and killed, where it sends nothing and does not end for as long. The message
  /// says which environment variable allows more.
  void set_patience(std::chrono::duration<double> patience, std::string variable) {
    patience_ = patience;
    patience_variable_ = std::move(variable);
  }

  /// The next bytes of its standard output, at most `bytes`; fewer only where the output ends, or
  /// where it was given up. \throws Cancelled within about a tenth of a second.
  Index read(void* to, Index bytes, const Context& context);

  /// How it ended.
  struct Ending {
    std::string why;         ///< "" where it exited with 0
    bool too_large = false;  ///< it exited with kTooLarge
  };
  static constexpr int kTooLarge = 4;

  /// Waits for its end; why is the last line that it wrote to standard error, or the signal that
  /// ended it, or that it was given up.
  Ending finish(const Context& context);

 private:
  /// Waits until there is output, keeping what comes on standard error. \return false where nothing
  /// came in time.
  bool wait_for_output();
  void keep_errors();

  pid_t pid_ = -1;
  int output_ = -1;
  int errors_ = -1;
  void check_patience();

  std::string error_text_;  ///< its end
  std::chrono::duration<double> patience_ = std::chrono::hours(24);
  std::string patience_variable_;
  std::chrono::steady_clock::time_point last_sign_ = std::chrono::steady_clock::now();
  bool given_up_ = false;
};

}  // namespace dsc::detail
