#include "tests/cli/program.h"

#include "libdsc/page/page.h"
#include "tests/support/long_tests.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace dsc::test {
namespace {

namespace fs = std::filesystem;

std::string drain(int file) {
  std::string text;
  char buffer[4096];
  for (ssize_t n = 0; (n = ::read(file, buffer, sizeof buffer)) > 0;) {
    text.append(buffer, static_cast<std::size_t>(n));
  }
  ::close(file);
  return text;
}

}  // namespace

Outcome run_dsc(const std::vector<std::string>& arguments, const std::function<void()>& in_child,
                const std::function<void(int)>& meanwhile) {
  int out[2], err[2];
  if (::pipe(out) != 0 || ::pipe(err) != 0) throw std::runtime_error("pipe");
  std::vector<char*> argv{const_cast<char*>("dsc")};
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("fork");
  if (child == 0) {
    ::dup2(out[1], STDOUT_FILENO);
    ::dup2(err[1], STDERR_FILENO);
    for (const int file : {out[0], out[1], err[0], err[1]}) ::close(file);
    if (in_child) in_child();
    ::execv(DSC_PROGRAM, argv.data());
    ::_exit(127);
  }
  ::close(out[1]);
  ::close(err[1]);
  Outcome outcome;
  std::thread errors([&] { outcome.err = drain(err[0]); });
  if (meanwhile) meanwhile(child);
  outcome.out = drain(out[0]);
  errors.join();
  int status = 0;
  rusage usage{};
  ::wait4(child, &status, 0, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  outcome.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  outcome.peak_bytes = std::int64_t{usage.ru_maxrss} * 1024;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return outcome;
}

void expect_refused(const Outcome& outcome, int exit_code, const Words& parts) {
  EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err.rfind("dsc: ", 0), 0U) << outcome.err;
  for (const std::string& part : parts) {
    EXPECT_NE(outcome.err.find(part), std::string::npos)
        << "'" << part << "' is not in " << outcome.err;
  }
}

Folder::Folder() {
  std::string pattern = (fs::temp_directory_path() / "dsc_cli_XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("mkdtemp");
  path_ = pattern;
}

Folder::~Folder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::vector<std::string> Folder::names() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(path_)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string test_data(const std::string& name) {
  const char* folder = std::getenv("DSC_TEST_DATA");
  return folder == nullptr ? "" : (fs::path(folder) / name).string();
}

Words seen_endings() {
  Words endings;
#ifdef DSC_WITH_PICTURES
  endings.emplace_back("png");
#endif
  if (has_pages()) endings.emplace_back("html");
  return endings;
}

std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in.is_open()) throw std::runtime_error("cannot open " + path);
  return {std::istreambuf_iterator<char>(in), {}};
}

nlohmann::json read_json(const std::string& path) { return nlohmann::json::parse(read_file(path)); }

void write_file(const std::string& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

bool has_ended(int child) {
  const std::string status = read_file("/proc/" + std::to_string(child) + "/stat");
  return status.substr(status.rfind(')') + 2, 1) == "Z";
}

std::chrono::milliseconds interrupt_limit() {
  return std::chrono::milliseconds(testing::usually_or_long(3000, 1000));
}

nlohmann::json report_of(const Words& arguments) {
  const Folder folder;
  const Outcome outcome = run_dsc(arguments + Words{"--report", folder / "report.json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return outcome.exit_code == 0 ? read_json(folder / "report.json") : nlohmann::json();
}

}  // namespace dsc::test
