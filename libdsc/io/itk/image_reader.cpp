// dsc-image-reader IMAGE: a medical image, by ITK, to a pipe on standard output (image_stream.h).
// On failure one line on stderr and exit code 1.
#include "libdsc/io/itk/image.h"

#include <itkMacro.h>
#include <itkObject.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>

#include <sys/resource.h>
#include <unistd.h>

namespace dsc::detail {
namespace {

/// A damaged file may ask for anything: this process gets no more than it can need.
void limit_resources() {
  const auto limit = [](int resource, rlim_t most) {
    rlimit now{};
    if (::getrlimit(resource, &now) != 0) return;
    now.rlim_cur = most < now.rlim_cur ? most : now.rlim_cur;
    (void)::setrlimit(resource, &now);
  };
#ifndef __SANITIZE_ADDRESS__  // its shadow alone is 20 TB
  limit(RLIMIT_AS, static_cast<rlim_t>(::sysconf(_SC_PHYS_PAGES)) *
                       static_cast<rlim_t>(::sysconf(_SC_PAGE_SIZE)));
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

int fail(std::string message) {
  for (char& c : message) c = c == '\n' || c == '\r' ? ' ' : c;
  std::fprintf(stderr, "%s\n", message.c_str());
  return 1;
}

}  // namespace
}  // namespace dsc::detail

int main(int argc, char** argv) {
  using namespace dsc::detail;
  if (argc != 2 || ::isatty(STDOUT_FILENO) != 0) {
    return fail("dsc-image-reader IMAGE reads an image for dsc, to a pipe");
  }
  limit_resources();
  itk::Object::GlobalWarningDisplayOff();
  try {
    run(argv[1]);
    return 0;
  } catch (const itk::ExceptionObject& error) {
    std::string text = error.GetDescription();  // itk::ERROR: Class(0x55…): what
    const std::size_t place = text.find("): ");
    return fail(place == std::string::npos ? text : text.substr(place + 3));
  } catch (const std::bad_alloc&) {
    return fail("there is no memory for it");
  } catch (const std::exception& error) {
    return fail(error.what());
  }
}
