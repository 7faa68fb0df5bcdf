/// \file
/// Readers of .ply, .vtp and .csv for the tests: written from the formats' descriptions, sharing
/// nothing with the writers, and strict. Failures throw std::runtime_error.
#pragma once

#include "libdsc/base/types.h"

#include <map>
#include <string>
#include <vector>

namespace dsc::test {

/// What the tests need of a PLY file: double properties, and one list of int32 per face.
struct PlyFile {
  std::vector<std::string> vertex_names, face_names;  ///< of the double properties, in order
  std::vector<std::vector<double>> vertices, face_values;
  std::vector<std::vector<std::int32_t>> faces;

  /// The values of some properties, interleaved.
  std::vector<double> vertex_columns(const std::vector<std::string>& names) const;
  std::vector<double> face_columns(const std::vector<std::string>& names) const;
};
PlyFile read_ply(const std::string& path);

/// An XML element; a minimal parser that insists on well-formed input.
struct XmlElement {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::vector<XmlElement> children;
  std::string text;

  const XmlElement& child(const std::string& child_name) const;
};
XmlElement read_xml(const std::string& text);

struct VtpFile {
  Index points = 0, polys = 0;
  XmlElement piece;
  std::string appended;  ///< what follows the underscore

  std::vector<double> doubles(const std::string& section, const std::string& name,
                              int components) const;
  std::vector<Index> integers(const std::string& section, const std::string& name) const;
  /// The names of an array's components; none where it names none.
  std::vector<std::string> parts(const std::string& section, const std::string& name) const;

 private:
  const XmlElement& array(const std::string& section, const std::string& name) const;
  std::string bytes(const XmlElement& array) const;
};
VtpFile read_vtp(const std::string& path);

struct CsvFile {
  std::vector<std::string> header;
  std::vector<std::vector<double>> rows;
};
CsvFile read_csv(const std::string& path);

/// All bytes of a file.
std::string read_text(const std::string& path);

}  // namespace dsc::test
