#include "libdsc/io/atomic_file.h"

#include "libdsc/base/error.h"
#include "libdsc/io/standard_stream.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <system_error>

namespace dsc {
namespace {

constexpr std::size_t kBuffer = std::size_t{1} << 20;
constexpr const char* kRename = "rename the temporary to";

/// Names of live temporaries, in static memory so that a signal handler can read them.
struct Slot {
  enum State : int { kFree, kClaimed, kCreating, kLive };
  std::atomic<int> state{kFree};
  char name[PATH_MAX];
};
static_assert(std::atomic<int>::is_always_lock_free);
constexpr int kSlots = 64;
Slot slots[kSlots];
std::atomic<unsigned> counter{0};
std::atomic<bool> closed{false};  ///< the process ends: no temporary may come any more

/// The slot that now holds `name`, which may be created next, or -1 where none is free.
int register_temporary(const std::string& name) {
  if (name.size() >= sizeof(Slot::name)) return -1;
  for (int i = 0; i < kSlots; ++i) {
    int expected = Slot::kFree;
    if (slots[i].state.compare_exchange_strong(expected, Slot::kClaimed)) {
      std::memcpy(slots[i].name, name.c_str(), name.size() + 1);
      slots[i].state.store(Slot::kCreating);
      return i;
    }
  }
  return -1;
}

thread_local FileGroup* group = nullptr;

[[noreturn]] void fail_to(const char* action, const std::string& path, int error) {
  throw OutputError("cannot " + std::string(action) + " '" + path +
                    "': " + std::system_category().message(error));
}

/// The new names themselves: best effort, the data is safe already.
void synchronise_folder_of(const std::string& target) {
  const std::string folder = std::filesystem::path(target).parent_path().string();
  const int directory = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (directory < 0) return;
  (void)::fsync(directory);
  (void)::close(directory);
}

}  // namespace

void AtomicFile::remove_all_temporaries() noexcept {
  closed.store(true);
  for (Slot& slot : slots) {
    // Who is about to create one either has seen `closed` or is waited for, a tenth of a second at
    // most: a file system may hang.
    const timespec pause{0, 1'000'000};
    for (int i = 0; i < 100 && slot.state.load() == Slot::kCreating; ++i)
      ::nanosleep(&pause, nullptr);
    const int state = slot.state.load();
    if (state == Slot::kLive || state == Slot::kCreating) (void)::unlink(slot.name);
  }
}

void AtomicFile::fail(const char* action, int error) const { fail_to(action, path_, error); }

AtomicFile::AtomicFile(const std::string& path) : path_(path) {
  namespace fs = std::filesystem;
  if (path.empty()) fail("write", ENOENT);
  if (detail::is_standard_stream(path)) {
    file_ = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
    if (file_ < 0) fail("write", errno);
    return;
  }
  struct stat info {};
  const bool exists = ::stat(path.c_str(), &info) == 0;
  if (!exists && errno != ENOENT) fail("write", errno);
  if (exists && S_ISDIR(info.st_mode)) fail("write", EISDIR);
  if (exists && !S_ISREG(info.st_mode)) {
    file_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (file_ < 0) fail("open", errno);
    return;
  }
  if (exists && ::access(path.c_str(), W_OK) != 0) fail("overwrite", errno);
  std::error_code error;
  target_ = fs::weakly_canonical(fs::absolute(path, error), error).string();
  if (error) fail("write", error.value());
  for (int attempt = 0; file_ < 0; ++attempt) {
    temporary_ = target_ + ".tmp-" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
    slot_ = register_temporary(temporary_);  // before it exists: a signal may come at any time
    if (slot_ < 0) fail("register a temporary for", EMFILE);
    file_ = closed.load()
                ? (errno = ECANCELED, -1)
                : ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file_ >= 0) {
      slots[slot_].state.store(Slot::kLive);
      break;
    }
    const int reason = errno;
    slots[slot_].state.store(Slot::kFree);
    slot_ = -1;
    if (reason != EEXIST || attempt > 100) fail("create a temporary beside", reason);
  }
  if (exists) (void)::fchmod(file_, info.st_mode & 07777);
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::discard() noexcept {
  if (file_ >= 0) (void)::close(file_);
  file_ = -1;
  if (slot_ >= 0) {
    (void)::unlink(temporary_.c_str());
    slots[slot_].state.store(Slot::kFree);
    slot_ = -1;
  }
}

void AtomicFile::write_through(const char* data, std::size_t bytes) {
  while (bytes > 0) {
    const ssize_t written = ::write(file_, data, bytes);
    if (written < 0) {
      if (errno == EINTR) continue;
      fail("write", errno);
    }
    data += written;
    bytes -= static_cast<std::size_t>(written);
  }
}

void AtomicFile::flush() {
  write_through(buffer_.data(), buffer_.size());
  buffer_.clear();
}

void AtomicFile::write(const void* data, std::size_t bytes) {
  if (file_ < 0) fail("write after the end of", EBADF);
  const char* from = static_cast<const char*>(data);
  if (buffer_.size() + bytes > kBuffer) flush();
  if (bytes >= kBuffer) {
    write_through(from, bytes);
  } else {
    buffer_.insert(buffer_.end(), from, from + bytes);
  }
}

void AtomicFile::commit() {
  if (file_ < 0) fail("commit twice", EBADF);
  flush();
  // Pipes and devices cannot be synchronised; regular files must be.
  if (::fsync(file_) != 0 && !temporary_.empty()) fail("flush to the disk", errno);
  const int file = file_;
  file_ = -1;
  if (::close(file) != 0) fail("close", errno);
  if (temporary_.empty()) return;
  if (group != nullptr) {
    group->files_.push_back({path_, target_, temporary_, slot_});
    slot_ = -1;
    return;
  }
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(kRename, errno);
  slots[slot_].state.store(Slot::kFree);
  slot_ = -1;
  synchronise_folder_of(target_);
}

FileGroup::FileGroup() : outer_(group) { group = this; }

FileGroup::~FileGroup() {
  group = outer_;
  for (const Committed& file : files_) {
    (void)::unlink(file.temporary.c_str());
    slots[file.slot].state.store(Slot::kFree);
  }
}

void FileGroup::publish() {
  // Every name first, so that as little time as can be lies between the first and the last.
  const std::vector<Committed> files = std::move(files_);
  files_.clear();
  const Committed* failed = nullptr;
  int reason = 0;
  for (const Committed& file : files) {
    if (::rename(file.temporary.c_str(), file.target.c_str()) == 0) continue;
    if (failed == nullptr) reason = errno;
    if (failed == nullptr) failed = &file;
    (void)::unlink(file.temporary.c_str());
  }
  for (const Committed& file : files) {
    slots[file.slot].state.store(Slot::kFree);
    synchronise_folder_of(file.target);
  }
  if (failed != nullptr) fail_to(kRename, failed->path, reason);
}

void check_writable(const std::string& path) {
  namespace fs = std::filesystem;
  if (detail::is_standard_stream(path)) return;
  const auto refuse = [&](const std::string& why) { throw OutputError("'" + path + "'" + why); };
  const auto reason = [] { return ": " + std::system_category().message(errno); };
  std::error_code error;
  const fs::path folder = fs::path(path).parent_path();
  if (fs::is_directory(path, error)) refuse(" is a folder; name a file in it");
  if (!folder.empty() && !fs::is_directory(folder, error)) {
    refuse(": the folder '" + folder.string() + "' does not exist; create it first");
  }
  if (::access(path.c_str(), F_OK) == 0) {
    if (::access(path.c_str(), W_OK) != 0) refuse(" cannot be overwritten" + reason());
    if (!fs::is_regular_file(path, error)) return;  // written directly
  }
  // The temporary comes beside the target, where links lead to.
  const fs::path target = fs::weakly_canonical(fs::absolute(path, error), error);
  if (!error && ::access(target.parent_path().c_str(), W_OK | X_OK) != 0) {
    refuse(" cannot be written: no file can be created in '" + target.parent_path().string() + "'" +
           reason());
  }
}

}  // namespace dsc
