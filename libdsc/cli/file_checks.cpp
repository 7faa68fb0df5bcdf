#include "libdsc/cli/file_checks.h"

#include "libdsc/base/error.h"
#include "libdsc/cli/picture_options.h"
#include "libdsc/io/atomic_file.h"
#include "libdsc/io/results.h"
#include "libdsc/io/standard_stream.h"
#include "libdsc/io/volume_writer.h"
#include "libdsc/page/page.h"
#include "libdsc/render/glb_file.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace dsc::cli {
namespace {

namespace fs = std::filesystem;

/// Where writing to `path` ends up: absolute, links resolved as far as files exist.
fs::path place_of(const std::string& path) {
  std::error_code error;
  const fs::path place = fs::weakly_canonical(fs::absolute(path, error), error);
  return error ? fs::path(path) : place;
}

bool same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  return fs::equivalent(a, b, error) || place_of(a) == place_of(b);
}

/// Pipes, terminals and /dev/null take any number of results.
bool is_stream(const std::string& path) {
  std::error_code error;
  return fs::exists(path, error) && !fs::is_regular_file(path, error);
}

void check_spares_input(const std::string& path, const std::string& input) {
  if (same_file(path, input)) {
    throw UsageError("'" + path + "' is the input '" + input +
                     "' and would be overwritten; write to another file");
  }
  std::error_code error;
  if (fs::is_directory(input, error) && fs::is_regular_file(path, error) &&
      fs::equivalent(place_of(path).parent_path(), input, error)) {
    throw UsageError("'" + path + "' is a file of the input folder '" + input +
                     "' and would be overwritten; write to another folder");
  }
}

}  // namespace

bool to_standard_output(const Options& o) {
  return std::any_of(o.outputs.begin(), o.outputs.end(), detail::is_standard_stream);
}

void check_files(const Options& o) {
  for (const std::string& path : o.outputs) {
    if (path == "-") throw UsageError("-o -: standard output needs a format, as in -o ply:-");
  }
  if (o.input == "-") throw UsageError("-: standard input needs a format, as in vol:- or ply:-");
  std::vector<std::string> files = o.outputs;
  if (!o.report.empty()) files.push_back(o.report);
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (is_stream(files[i])) continue;
    if (detail::is_standard_stream(files[i])) {
      for (std::size_t j = 0; j < i; ++j) {
        if (!detail::is_standard_stream(files[j])) continue;
        throw UsageError("'" + files[i] + "' and '" + files[j] + "' are both standard output");
      }
      continue;
    }
    if (o.input.rfind("shape:", 0) != 0) check_spares_input(files[i], o.input);
    for (std::size_t j = 0; j < i; ++j) {
      if (!same_file(files[i], files[j])) continue;
      throw UsageError("'" + files[i] + "' is to be written twice" +
                       (files[i] == files[j] ? "" : ", as '" + files[j] + "' too"));
    }
  }
  for (const std::string& path : o.outputs) {
    if (o.command == Command::voxels) {
      check_volume_path(path);
    } else if (is_written_volume_path(path)) {
      throw UsageError("'" + path + "' is a volume, which only dsc voxels writes; dsc " +
                       name_of(o.command) + " writes " + result_endings());
    } else if (is_page_path(path)) {
      check_page_path(path);
    } else {
      const bool drawn = is_picture_path(path) || render::is_glb_path(path);
      drawn ? check_writable(path) : check_result_path(path);
    }
  }
  if (!o.report.empty()) check_writable(o.report);
}

}  // namespace dsc::cli
