#include "libdsc/cli/interruption.h"

#include "libdsc/io/atomic_file.h"
#include "libdsc/io/child_process.h"

#include <csignal>
#include <string_view>
#include <thread>

#include <unistd.h>

namespace dsc::cli {

void watch_signals(std::shared_ptr<Monitor> monitor) {
  std::signal(SIGXFSZ, SIG_IGN);
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  // Blocked here and so in every thread to come; the watcher alone takes them, outside of any
  // signal handler, where everything may be called.
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread([signals, monitor = std::move(monitor)] {
    int signal = 0;
    if (sigwait(&signals, &signal) != 0) return;
    monitor->cancel();
    const timespec grace{0, 800'000'000};
    sigtimedwait(&signals, nullptr, &grace);
    AtomicFile::remove_all_temporaries();
    detail::ChildProcess::kill_all();
    constexpr std::string_view kMessage = "\ndsc: interrupted\n";
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, kMessage.data(), kMessage.size());
    ::_exit(kInterruptedExitCode);
  }).detach();
}

}  // namespace dsc::cli
