/// \file
/// The options that several commands share, by the groups that help texts show.
#pragma once

#include "libdsc/cli/options.h"

#include <CLI/CLI.hpp>

namespace dsc::cli {

/// INPUT and which of its voxels are inside.
void add_input(CLI::App& app, Options& o);
/// Threads, report, quiet; and the outputs where the command `writes`.
void add_run(CLI::App& app, Options& o, bool writes);
/// How normals are estimated.
void add_normals(CLI::App& app, Options& o);
/// The same, and how operators are made from them, the Laplacian too or not.
void add_calculus(CLI::App& app, Options& o, bool laplacian);
/// The result of another calculus as a further field.
void add_compare(CLI::App& app, Options& o);
/// Points and vertices as sources. The caller names the group.
void add_sources(CLI::App& app, Options& o);

}  // namespace dsc::cli
