/// \file
/// The options that several commands share, by the groups that help texts show.
#pragma once

#include "libdsc/cli/options.h"

#include <CLI/CLI.hpp>

namespace dsc::cli {

/// INPUT and which of its voxels are inside; how their surface is extracted where the command
/// `extracts` it.
void add_input(CLI::App& app, Options& o, bool extracts);
/// What a command writes.
enum class Writes { nothing, results, volumes };
/// Threads, report, quiet; and the outputs.
void add_run(CLI::App& app, Options& o, Writes writes);
/// How normals are estimated.
void add_normals(CLI::App& app, Options& o);
/// The same, and how operators are made from them, the Laplacian too or not.
void add_calculus(CLI::App& app, Options& o, bool laplacian);
/// The result of another calculus as a further field.
void add_compare(CLI::App& app, Options& o);
/// Points and vertices as sources. The caller names the group.
void add_sources(CLI::App& app, Options& o);

}  // namespace dsc::cli
