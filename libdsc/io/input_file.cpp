#include "libdsc/io/input_file.h"

#include "libdsc/base/error.h"
#include "libdsc/io/standard_stream.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace dsc {

namespace {

/// Whether there is something to read, or the end, within a tenth of a second.
bool standard_input_is_ready() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  return ::poll(&input, 1, 100) != 0;
}

std::string all_of_standard_input(const Context& context) {
  std::string bytes;
  char buffer[1 << 16];
  for (;;) {
    context.check();
    if (!standard_input_is_ready()) continue;
    const ssize_t count = ::read(STDIN_FILENO, buffer, sizeof buffer);
    if (count == 0) return bytes;
    if (count > 0) {
      const std::size_t size = bytes.size() + static_cast<std::size_t>(count);
      if (size > bytes.capacity()) {  // it grows to twice its size beside itself
        context.need("read", static_cast<Index>(2 * size));
        bytes.reserve(2 * size);
      }
      bytes.append(buffer, static_cast<std::size_t>(count));
    } else if (errno != EINTR) {
      throw InputError("cannot read standard input: " + std::system_category().message(errno));
    }
  }
}

}  // namespace

InputFile::InputFile(const std::string& path, const Context& context) : path_(path) {
  if (detail::is_standard_stream(path)) {
    owned_ = std::make_shared<const std::string>(all_of_standard_input(context));
    bytes_ = *owned_;
    size_ = static_cast<Index>(bytes_.size());
    return;
  }
  const auto refuse = [&](int error) {
    throw InputError("cannot read '" + path + "': " + std::system_category().message(error));
  };
  // Not blocking: a pipe without a writer is refused below instead of waited for.
  file_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file_ < 0) refuse(errno);
  struct stat info {};
  if (::fstat(file_, &info) != 0) {
    const int error = errno;
    (void)::close(file_);
    refuse(error);
  }
  if (!S_ISREG(info.st_mode)) {
    (void)::close(file_);
    throw InputError(
        "cannot read '" + path +
        "': it is no regular file; read a pipe's data from standard input, by the name FORMAT:-");
  }
  size_ = info.st_size;
}

InputFile::InputFile(std::string name, std::string_view bytes)
    : path_(std::move(name)), bytes_(bytes), size_(static_cast<Index>(bytes.size())) {}

InputFile::InputFile(InputFile&& other) noexcept
    : path_(std::move(other.path_)),
      file_(std::exchange(other.file_, -1)),
      owned_(std::move(other.owned_)),
      bytes_(other.bytes_),
      size_(other.size_),
      position_(other.position_) {}

InputFile::~InputFile() {
  if (file_ >= 0) (void)::close(file_);
}

void InputFile::fail(Index at, const std::string& why) const {
  throw InputError("'" + path_ + "', byte " + std::to_string(at) + ": " + detail::printable(why));
}

Index InputFile::read_some(void* to, Index bytes) {
  if (file_ < 0) {
    const Index count = std::clamp<Index>(remaining(), 0, bytes);
    if (count > 0) std::memcpy(to, bytes_.data() + position_, static_cast<std::size_t>(count));
    position_ += count;
    return count;
  }
  for (;;) {
    const ssize_t count = ::pread(file_, to, static_cast<std::size_t>(bytes), position_);
    if (count >= 0) {
      position_ += count;
      return count;
    }
    if (errno != EINTR) fail(position_, std::system_category().message(errno));
  }
}

void InputFile::read(void* to, Index bytes) {
  char* next = static_cast<char*>(to);
  while (bytes > 0) {
    const Index count = read_some(next, bytes);
    if (count == 0)
      fail(position_, "the file ends here, " + std::to_string(bytes) + " bytes short");
    next += count;
    bytes -= count;
  }
}

void InputFile::seek(Index position) { position_ = position; }

namespace detail {

std::string printable(std::string text) {
  constexpr std::size_t kMost = 600, kStart = 400, kEnd = 190;
  if (text.size() > kMost) text.replace(kStart, text.size() - kStart - kEnd, " ... ");
  for (char& c : text) c = c >= ' ' && c < 127 ? c : '?';
  return text;
}

}  // namespace detail
}  // namespace dsc
