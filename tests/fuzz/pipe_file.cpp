#include "tests/fuzz/pipe_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

namespace dsc::fuzz {
namespace {
constexpr int kCapacity = 1 << 20;
}

PipeFile::PipeFile(const std::string& ending) {
  folder_ = (std::filesystem::temp_directory_path() / "dsc-fuzz-XXXXXX").string();
  if (::mkdtemp(folder_.data()) == nullptr) throw std::runtime_error("mkdtemp: " + folder_);
  path_ = folder_ + "/fuzz" + ending;
  if (::pipe2(ends_, O_CLOEXEC | O_NONBLOCK) != 0 ||
      ::fcntl(ends_[1], F_SETPIPE_SZ, kCapacity) < kCapacity) {
    throw std::runtime_error("no pipe of 1 MB");
  }
  const std::string end = "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(ends_[1]);
  if (::symlink(end.c_str(), path_.c_str()) != 0) throw std::runtime_error("symlink: " + path_);
}

PipeFile::~PipeFile() {
  (void)::close(ends_[0]);
  (void)::close(ends_[1]);
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

const std::string& PipeFile::take() {
  bytes_.clear();
  char block[4096];
  for (ssize_t n = 0; (n = ::read(ends_[0], block, sizeof block)) > 0;) {
    bytes_.append(block, static_cast<std::size_t>(n));
  }
  return bytes_;
}

}  // namespace dsc::fuzz
