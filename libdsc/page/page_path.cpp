// What a build without pages has too.
#include "libdsc/page/page.h"

#include "libdsc/base/error.h"
#include "libdsc/io/path_extension.h"

namespace dsc {

bool is_page_path(const std::string& path) {
  const std::string extension = extension_of(path);
  return extension == ".html" || extension == ".htm";
}

#ifndef DSC_WITH_PAGE
bool has_pages() { return false; }

void check_page_path(const std::string& path) {
  throw UsageError("'" + path +
                   "': this build of libdsc writes no pages; configure it with "
                   "-DDSC_WITH_PAGE=ON (Debian: libjs-three)");
}

void write_page(const std::string& path, const Result&, const Context&) { check_page_path(path); }
#endif

}  // namespace dsc
