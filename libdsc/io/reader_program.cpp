#include "libdsc/io/reader_program.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <exception>
#include <limits>
#include <new>
#include <string_view>

#include <sys/resource.h>
#include <unistd.h>

namespace dsc::detail {
namespace {

constexpr int kTooLarge = 4;  // the exit code that the parent knows

/// A damaged file may ask for anything: this process gets no more than `bytes` of memory, beside
/// what its libraries and threads take themselves, and no more of the rest than it can need.
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

int fail(std::string message, int code) {
  for (char& c : message) c = c == '\n' || c == '\r' ? ' ' : c;
  std::fprintf(stderr, "%s\n", message.c_str());
  return code;
}

/// Nothing where the words are none that the program knows.
std::optional<ImageRequest> request_of(const ReaderMain& reader, int argc, char** argv) {
  if (argc < 2 || argc > (reader.takes_part ? 4 : 3)) return std::nullopt;
  ImageRequest request{argv[1], std::nullopt, std::numeric_limits<std::size_t>::max()};
  if (argc > 2) {
    const std::string_view given = argv[2];
    const char* end = given.data() + given.size();
    const auto [last, error] = std::from_chars(given.data(), end, request.bytes);
    if (given.empty() || error != std::errc{} || last != end) return std::nullopt;
  }
  if (argc > 3) request.part = argv[3];
  return request;
}

}  // namespace

int run_reader(const ReaderMain& reader, int argc, char** argv) {
  const std::optional<ImageRequest> request = request_of(reader, argc, argv);
  if (!request || ::isatty(STDOUT_FILENO) != 0) return fail(reader.usage, 1);
  limit_resources(static_cast<rlim_t>(request->bytes));
  try {
    const std::unique_ptr<Image> image = reader.open(*request);
    const std::string part = image->part().substr(0, kLongestName);
    ImageHeader header = image->header();
    header.name_bytes = static_cast<std::int32_t>(part.size());
    write_all(&header, sizeof header);
    write_all(part.data(), part.size());
    image->read(write_all);
    write_all(kImageEnd, sizeof kImageEnd);
    return 0;
  } catch (const std::bad_alloc&) {
    return fail("its values do not fit in the memory that is left; use a part of it, or allow more",
                kTooLarge);
  } catch (const ImageTooLarge& error) {
    return fail(error.what(), kTooLarge);
  } catch (const ImageError& error) {
    return fail(error.what(), 1);
  } catch (const std::exception& error) {
    return fail(reader.message(error), 1);
  }
}

}  // namespace dsc::detail
