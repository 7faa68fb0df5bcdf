#include "libdsc/io/child_process.h"

#include "libdsc/base/error.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>

extern char** environ;

namespace dsc::detail {
namespace {

constexpr int kPollMilliseconds = 100;

/// The children that live, in static memory so that a signal handler can read it. One too many is
/// not remembered: it would only outlive an interrupted program.
std::atomic<pid_t> children[16];
static_assert(std::atomic<pid_t>::is_always_lock_free);

void replace_child(pid_t old_pid, pid_t new_pid) {
  for (std::atomic<pid_t>& child : children) {
    pid_t expected = old_pid;
    if (child.compare_exchange_strong(expected, new_pid)) return;
  }
}

struct Pipe {
  int ends[2] = {-1, -1};
  Pipe() {
    if (::pipe2(ends, O_CLOEXEC) != 0) {
      throw InputError("no pipe can be made: " + std::system_category().message(errno));
    }
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    for (const int end : ends) {
      if (end >= 0) (void)::close(end);
    }
  }
  int take_reading_end() {
    const int end = ends[0];
    ends[0] = -1;
    return end;
  }
};

int spawn(pid_t& pid, const std::string& path, char* const* argv, int output, int errors) {
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&actions);
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
  // Whoever watches signals blocks them in every thread; the child must not inherit that.
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  const int result = ::posix_spawn(&pid, path.c_str(), &actions, &attributes, argv, environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return result;
}

}  // namespace

ChildProcess::ChildProcess(const std::string& path, const std::vector<std::string>& arguments) {
  Pipe output, errors;
  std::vector<std::string> words{path};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const int result = spawn(pid_, path, argv.data(), output.ends[1], errors.ends[1]);
  if (result != 0) {
    pid_ = -1;
    throw InputError("cannot start '" + path + "': " + std::system_category().message(result));
  }
  replace_child(0, pid_);
  output_ = output.take_reading_end();
  errors_ = errors.take_reading_end();
  (void)::fcntl(output_, F_SETPIPE_SZ, 1 << 20);
  (void)::fcntl(errors_, F_SETFL, O_NONBLOCK);
}

ChildProcess::~ChildProcess() {
  if (pid_ > 0) {
    (void)::kill(pid_, SIGKILL);
    replace_child(pid_, 0);
    while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  (void)::close(output_);
  (void)::close(errors_);
}

void ChildProcess::kill_all() noexcept {
  for (const std::atomic<pid_t>& child : children) {
    if (const pid_t pid = child.load(); pid > 0) (void)::kill(pid, SIGKILL);
  }
}

void ChildProcess::keep_errors() {
  constexpr std::size_t kKept = 4096;
  char buffer[1024];
  for (ssize_t n = 0; (n = ::read(errors_, buffer, sizeof buffer)) > 0;) {
    error_text_.append(buffer, static_cast<std::size_t>(n));
    if (error_text_.size() > 2 * kKept) error_text_.erase(0, error_text_.size() - kKept);
  }
}

bool ChildProcess::wait_for_output() {
  pollfd files[] = {{output_, POLLIN, 0}, {errors_, POLLIN, 0}};
  (void)::poll(files, 2, kPollMilliseconds);
  if ((files[1].revents & POLLIN) != 0) keep_errors();
  return files[0].revents != 0;
}

Index ChildProcess::read(void* to, Index bytes, const Context& context) {
  Index done = 0;
  while (done < bytes) {
    context.check();
    if (!wait_for_output()) {
      check_patience();
      continue;
    }
    const ssize_t n =
        ::read(output_, static_cast<char*>(to) + done, static_cast<std::size_t>(bytes - done));
    if (n == 0) break;
    if (n <= 0) continue;
    done += n;
    last_sign_ = std::chrono::steady_clock::now();
  }
  return done;
}

/// After the kill its output ends, and so does read().
void ChildProcess::check_patience() {
  if (given_up_ || std::chrono::steady_clock::now() - last_sign_ < patience_) return;
  given_up_ = true;
  (void)::kill(pid_, SIGKILL);
}

ChildProcess::Ending ChildProcess::finish(const Context& context) {
  int status = 0;
  for (;;) {
    context.check();
    const pid_t ended = ::waitpid(pid_, &status, WNOHANG);
    if (ended == pid_) break;
    check_patience();
    pollfd file{errors_, POLLIN, 0};
    (void)::poll(&file, 1, kPollMilliseconds / 10);
    keep_errors();
  }
  replace_child(pid_, 0);
  pid_ = -1;
  keep_errors();
  if (given_up_) {
    const auto seconds = static_cast<Index>(patience_.count());
    return {
        "its reader sent nothing for " + std::to_string(seconds) +
            " seconds and was given up; the file is damaged, or the disk or network too slow: " +
            patience_variable_ + " allows more",
        false};
  }
  if (WIFSIGNALED(status)) {
    return {std::string("its reader was ended by the signal '") + ::strsignal(WTERMSIG(status)) +
                "'; the file is damaged or too large",
            false};
  }
  if (WEXITSTATUS(status) == 0) return {};
  while (error_text_.ends_with('\n')) error_text_.pop_back();
  const std::size_t line = error_text_.rfind('\n');
  const std::string last = line == std::string::npos ? error_text_ : error_text_.substr(line + 1);
  return {last.empty() ? "its reader gave up with exit code " + std::to_string(WEXITSTATUS(status))
                       : last,
          WEXITSTATUS(status) == kTooLarge};
}

}  // namespace dsc::detail
