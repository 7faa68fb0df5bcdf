#include "tests/benchmarks/report/process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <stdexcept>

namespace report {
namespace {

std::string joined(const std::vector<std::string>& command) {
  std::string text;
  for (const std::string& word : command) text += (text.empty() ? "" : " ") + word;
  return text;
}

/// Starts `command`; its standard output goes to `output`. Does not return in the child.
pid_t start(const std::vector<std::string>& command, int output) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start " + command[0]);
  if (child == 0) {
    dup2(output, STDOUT_FILENO);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  return child;
}

rusage finish(pid_t child, const std::vector<std::string>& command) {
  int status = 0;
  rusage usage{};
  if (wait4(child, &status, 0, &usage) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw std::runtime_error("failed: " + joined(command));
  }
  return usage;
}

}  // namespace

Finished run(const std::vector<std::string>& command) {
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) throw std::runtime_error("cannot open /dev/null");
  const auto begin = std::chrono::steady_clock::now();
  const pid_t child = start(command, nowhere);
  close(nowhere);
  const rusage usage = finish(child, command);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  return {took.count(), 1024. * static_cast<double>(usage.ru_maxrss)};
}

std::string output_of(const std::vector<std::string>& command) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("cannot open a pipe");
  const pid_t child = start(command, ends[1]);
  close(ends[1]);
  std::string text;
  std::array<char, 1 << 14> buffer;
  for (;;) {
    const ssize_t got = read(ends[0], buffer.data(), buffer.size());
    if (got <= 0) break;
    text.append(buffer.data(), static_cast<std::size_t>(got));
  }
  close(ends[0]);
  finish(child, command);
  return text;
}

WorkFolder::WorkFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "dsc-report-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make " + name);
  path_ = name;
}

WorkFolder::~WorkFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace report
