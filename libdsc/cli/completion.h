/// \file
/// Texts made from the command line's own description, so that they cannot go out of date: scripts
/// that complete it in shells, and the manual page.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace dsc::cli {

/// For `source <(dsc --completion bash)`, or a file in bash's folder of completions.
std::string bash_completion(const CLI::App& app);

/// For a file `_dsc` in a folder of zsh's fpath.
std::string zsh_completion(const CLI::App& app);

/// dsc(1), as roff.
std::string manual_page(const CLI::App& app);

}  // namespace dsc::cli
