// What a build without pages has too.
#include "libdsc/page/page.h"

#include "libdsc/base/error.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace dsc {

bool is_page_path(const std::string& path) {
  if (path == "html:-") return true;  // standard output
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".html" || ending == ".htm";
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
