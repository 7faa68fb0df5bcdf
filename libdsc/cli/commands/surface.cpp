#include "libdsc/cli/commands/commands.h"
#include "libdsc/cli/stages.h"

namespace dsc::cli {

void run_surface(Run& run) {
  const Input input = read_input(run);
  const DigitalSurface surface = extract(input, run);
  write_outputs({surface.flat(false), {}}, run);
}

}  // namespace dsc::cli
