#include "libdsc/cli/commands/commands.h"
#include "libdsc/cli/stages.h"

namespace dsc::cli {

void run_surface(Run& run) {
  const Scene scene = open_scene(run);
  write_outputs(scene, {scene.surface.flat(false), {}}, run);
}

}  // namespace dsc::cli
