#include "libdsc/cli/commands/commands.h"
#include "libdsc/cli/stages.h"

namespace dsc::cli {

void run_surface(Run& run) {
  const Scene scene = open_scene(run);
  const FlatMesh mesh = scene.polygons ? scene.polygons->view() : scene.surface.flat(false);
  write_outputs(scene, {mesh, {}}, run);
}

}  // namespace dsc::cli
