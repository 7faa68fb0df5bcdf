/// \file
/// The subcommands. Each fills the run's report and writes the run's outputs.
#pragma once

#include "libdsc/cli/run.h"

namespace dsc::cli {

void run_info(Run& run);
void run_voxels(Run& run);
void run_surface(Run& run);
void run_normals(Run& run);
void run_gradient(Run& run);
void run_diffuse(Run& run);
void run_geodesic(Run& run);
void run_spectrum(Run& run);
void run_curvature(Run& run);
void run_laplacian(Run& run);
void run_poisson(Run& run);

}  // namespace dsc::cli
