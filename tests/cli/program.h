/// \file
/// Runs the real program, as a shell would.
#pragma once

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace dsc::test {

/// A command line, or a part of one.
using Words = std::vector<std::string>;

inline Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

struct Outcome {
  int exit_code = -1;  ///< 128 + the signal's number where one ended the program
  std::string out;
  std::string err;
  double cpu_seconds = 0;       ///< of the program and what it started
  std::int64_t peak_bytes = 0;  ///< resident; at least what this process holds itself
};

/// Runs `dsc` with these arguments and waits for it. `in_child` is called between fork and exec;
/// `meanwhile` in the parent, with the child's process id, once it runs.
Outcome run_dsc(const std::vector<std::string>& arguments,
                const std::function<void()>& in_child = {},
                const std::function<void(int)>& meanwhile = {});

/// Whether a child has, and waits to be asked how.
bool has_ended(int child);

/// How long an interrupted run may take. A second is what is promised; a machine that runs other
/// tests beside this one may take longer.
std::chrono::milliseconds interrupt_limit();

/// Expects this exit code, nothing on standard output, and a message that begins with the program's
/// name and has each of `parts`.
void expect_refused(const Outcome& outcome, int exit_code, const Words& parts);

/// A fresh folder, removed at the end of its scope.
class Folder {
 public:
  Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder();

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  /// The names in it, sorted.
  std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

/// The report of a run that succeeds; null where it does not, and the test fails.
nlohmann::json report_of(const Words& arguments);

/// The endings of pictures and pages, where this build makes them.
Words seen_endings();

/// A file of DSC_TEST_DATA, or "" where that is not set.
std::string test_data(const std::string& name);

nlohmann::json read_json(const std::string& path);
std::string read_file(const std::string& path);
void write_file(const std::string& path, const std::string& content);

}  // namespace dsc::test
