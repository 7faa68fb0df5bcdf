#include "libdsc/cli/commands/commands.h"
#include "libdsc/cli/stages.h"

namespace dsc::cli {

void run_info(Run& run) {
  const Input input = read_input(run);
  extract(input, run);
}

}  // namespace dsc::cli
