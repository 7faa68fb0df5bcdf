// dsc-image-reader IMAGE [BYTES]: a medical image, by ITK, to a pipe on standard output
// (image_stream.h), in so much memory. On failure one line on stderr and exit code 1, or 4 where
// the image is too large.
#include "libdsc/io/itk/image.h"

#include <itkMacro.h>
#include <itkObject.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <string_view>

#include <sys/resource.h>
#include <unistd.h>

namespace dsc::detail {
namespace {

constexpr int kTooLarge = 4;  // the exit code that the parent knows

/// A damaged file may ask for anything: this process gets no more than `bytes` of memory, beside
/// what ITK's libraries and threads take themselves, and no more of the rest than it can need.
void limit_resources(rlim_t bytes) {
  const auto limit = [](int resource, rlim_t most) {
    rlimit now{};
    if (::getrlimit(resource, &now) != 0) return;
    now.rlim_cur = most < now.rlim_cur ? most : now.rlim_cur;
    (void)::setrlimit(resource, &now);
  };
#ifndef __SANITIZE_ADDRESS__  // its shadow alone is 20 TB
  constexpr rlim_t kItself = rlim_t{64} << 20;
  const auto physical = static_cast<rlim_t>(::sysconf(_SC_PHYS_PAGES)) *
                        static_cast<rlim_t>(::sysconf(_SC_PAGE_SIZE));
  limit(RLIMIT_AS, physical);
  limit(RLIMIT_DATA, std::min(bytes, physical) + kItself);
#endif
  limit(RLIMIT_CPU, 3600);  // seconds
  limit(RLIMIT_FSIZE, 0);   // it writes no file
  limit(RLIMIT_CORE, 0);
}

void write_all(const void* bytes, std::size_t count) {
  const char* next = static_cast<const char*>(bytes);
  while (count > 0) {
    const ssize_t written = ::write(STDOUT_FILENO, next, count);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw ImageError(std::string("standard output: ") + std::strerror(errno));
    next += written;
    count -= static_cast<std::size_t>(written);
  }
}

void run(const std::string& path) {
  const std::unique_ptr<Image> image = open_image(path);
  const ImageHeader header = image->header();
  (void)value_bytes(header);
  write_all(&header, sizeof header);
  image->read(write_all);
  write_all(kImageEnd, sizeof kImageEnd);
}

int fail(std::string message, int code) {
  for (char& c : message) c = c == '\n' || c == '\r' ? ' ' : c;
  std::fprintf(stderr, "%s\n", message.c_str());
  return code;
}

}  // namespace
}  // namespace dsc::detail

int main(int argc, char** argv) {
  using namespace dsc::detail;
  rlim_t bytes = RLIM_INFINITY;
  const std::string_view given = argc == 3 ? argv[2] : "";
  const bool number = std::from_chars(given.data(), given.data() + given.size(), bytes).ptr ==
                      given.data() + given.size();
  if (argc < 2 || argc > 3 || (argc == 3 && (given.empty() || !number)) ||
      ::isatty(STDOUT_FILENO) != 0) {
    return fail("dsc-image-reader IMAGE [BYTES] reads an image for dsc, to a pipe", 1);
  }
  limit_resources(bytes);
  itk::Object::GlobalWarningDisplayOff();
  try {
    run(argv[1]);
    return 0;
  } catch (const itk::ExceptionObject& error) {
    std::string text = error.GetDescription();  // itk::ERROR: Class(0x55…): what
    const std::size_t place = text.find("): ");
    return fail(place == std::string::npos ? text : text.substr(place + 3), 1);
  } catch (const std::bad_alloc&) {
    return fail("its values do not fit in the memory that is left; use a part of it, or allow more",
                kTooLarge);
  } catch (const ImageTooLarge& error) {
    return fail(error.what(), kTooLarge);
  } catch (const std::exception& error) {
    return fail(error.what(), 1);
  }
}
