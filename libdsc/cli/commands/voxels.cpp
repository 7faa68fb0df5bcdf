#include "libdsc/cli/commands/commands.h"
#include "libdsc/cli/input.h"
#include "libdsc/io/volume_writer.h"

#include <fmt/format.h>

namespace dsc::cli {

void run_voxels(Run& run) {
  const Input input = read_input(run);
  const Stopwatch watch(run.report.timings.write);
  VolumeWriteOptions options;
  options.world = input.world;
  for (const std::string& path : run.options.outputs) {
    const std::vector<std::string> left_out = std::visit(
        [&](const auto& volume) { return write_volume(path, volume, options, run.context); },
        input.voxels);
    for (const std::string& what : left_out) {
      run.warn(fmt::format("'{}' has no room for {}; write .vti as well", path, what));
    }
    run.report.outputs.push_back(path);
  }
}

}  // namespace dsc::cli
