#include "libdsc/cli/commands/commands.h"
#include "libdsc/cli/stages.h"

namespace dsc::cli {

void run_info(Run& run) { open_scene(run); }

}  // namespace dsc::cli
