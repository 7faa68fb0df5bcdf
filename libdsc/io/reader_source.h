/// \file
/// \internal
/// Volumes that a program of its own reads for the library, because what it reads them with may
/// crash or take any memory on a damaged file, or is too much to link.
#pragma once

#include "libdsc/io/volume_source.h"

#include <memory>
#include <optional>
#include <string>

namespace dsc::detail {

struct ReaderProgram {
  const char* name;      ///< of its file
  const char* variable;  ///< of the environment, that names it; with _SECONDS, how long to wait
  const char* option;    ///< of CMake, that builds it
};

/// Starts the program on the file and takes its header; VolumeSource::read takes the rest.
/// \param part what of the file to read, where the format holds several volumes.
/// \throws as open_volume(); what the program says is an InputError, or a LimitError where it
/// exits with ChildProcess::kTooLarge.
std::unique_ptr<VolumeSource> open_by_reader(const ReaderProgram& program, const std::string& path,
                                             const std::optional<std::string>& part,
                                             const Context& context);

}  // namespace dsc::detail
