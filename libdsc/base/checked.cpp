#include "libdsc/base/checked.h"

#include <unistd.h>

namespace dsc {

void check_allocation(Index bytes, const std::string& what) {
  const long pages = ::sysconf(_SC_PHYS_PAGES);
  const long page = ::sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page <= 0) return;  // the system does not say
  const Index memory = static_cast<Index>(pages) * page;
  if (bytes > memory) {
    throw LimitError(what + " would take " + std::to_string(bytes >> 20) +
                     " MiB, the machine has " + std::to_string(memory >> 20) +
                     "; use a coarser grid or a part");
  }
}

}  // namespace dsc
