/// \file
/// Files opened by Python: what has to be in them goes to read_results.py as JSON, and it says what
/// is wrong.
#pragma once

#include "tests/io/temporary_folder.h"

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace dsc::test {

template <class Values, class Text>
std::string json_list(const Values& values, const Text& text) {
  std::string list;
  for (const auto& value : values) list += (list.empty() ? "[" : ",") + text(value);
  return list.empty() ? "[]" : list + "]";
}

/// Hexadecimal, so that not a bit is lost.
inline std::string json_list(const std::vector<double>& values) {
  return json_list(values, [](double value) {
    char text[64];
    std::snprintf(text, sizeof text, "\"%a\"", value);
    return std::string(text);
  });
}

template <class Integers>
std::string json_integers(const Integers& values) {
  return json_list(values, [](auto value) { return std::to_string(value); });
}

/// Corners of each face.
template <class Mesh>
std::string json_faces(const Mesh& mesh) {
  std::string faces;
  for (auto f = decltype(mesh.faces()){0}; f < mesh.faces(); ++f) {
    faces += (f == 0 ? "" : ",") + json_integers(mesh.face(f));
  }
  return "[" + faces + "]";
}

#ifdef DSC_PYTHON
/// Checks the files of these forms in `folder`, which has truth.json beside them.
/// \return 0, or 1 where something is wrong, which `said` then tells.
inline int check_by_python(const std::string& folder, const std::string& forms,
                           std::string* said = nullptr) {
  const std::string command = std::string(DSC_PYTHON " " DSC_READ_RESULTS " '") + folder + "' " +
                              forms + " > '" + folder + "/said' 2>&1";
  const int status = std::system(command.c_str());
  if (said != nullptr) *said = read_all(folder + "/said");
  return WEXITSTATUS(status);
}
#endif

}  // namespace dsc::test
