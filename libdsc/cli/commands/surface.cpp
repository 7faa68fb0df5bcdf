#include "libdsc/cli/commands/commands.h"
#include "libdsc/cli/smooth_surface.h"

namespace dsc::cli {

void run_surface(Run& run) {
  Scene scene = open_scene(run);
  if (!run.options.regularise) {
    write_outputs(scene, {scene.mesh(), {}}, run);
    return;
  }
  if (!scene.polygons) estimate_normals(scene, run);
  write_outputs(scene, {regularised_surface(scene, run).mesh, {}}, run);
}

}  // namespace dsc::cli
