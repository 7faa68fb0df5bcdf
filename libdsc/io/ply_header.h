/// \file
/// \internal
/// The header of a PLY file.
#pragma once

#include "libdsc/io/text_lines.h"

#include <optional>
#include <string>
#include <vector>

namespace dsc::detail {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
Index bytes_of(PlyType type);
bool is_integer(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;  ///< of the value, or of a list's items
  std::optional<PlyType> count;     ///< of a list's length
};

struct PlyElement {
  std::string name;
  Index count = 0;
  Index line = 0;  ///< that declares it
  std::vector<PlyProperty> properties;
};

enum class PlyEncoding { text, little_endian, big_endian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::text;
  std::vector<PlyElement> elements;
};

/// Reads up to end_header. \throws InputError naming the line.
PlyHeader read_ply_header(TextLines& lines);

}  // namespace dsc::detail
