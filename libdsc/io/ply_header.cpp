#include "libdsc/io/ply_header.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>

namespace dsc::detail {
namespace {

constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes{
    {{"char", PlyType::int8},
     {"int8", PlyType::int8},
     {"uchar", PlyType::uint8},
     {"uint8", PlyType::uint8},
     {"short", PlyType::int16},
     {"int16", PlyType::int16},
     {"ushort", PlyType::uint16},
     {"uint16", PlyType::uint16},
     {"int", PlyType::int32},
     {"int32", PlyType::int32},
     {"uint", PlyType::uint32},
     {"uint32", PlyType::uint32},
     {"float", PlyType::float32},
     {"float32", PlyType::float32},
     {"double", PlyType::float64},
     {"float64", PlyType::float64}}};

/// Far more than any program writes; each is looked at for each vertex or face.
constexpr int kMostProperties = 10000;

PlyType read_type(TextLines& lines) {
  const std::string word(lines.word().substr(0, 40));
  for (const auto& [name, type] : kTypes) {
    if (name == word) return type;
  }
  lines.fail("'" + word + "' is no type of PLY; char to uint, float and double are");
}

PlyProperty read_property(TextLines& lines) {
  PlyProperty property;
  if (lines.rest().starts_with("list ")) {
    (void)lines.word();
    property.count = read_type(lines);
    if (!is_integer(*property.count)) lines.fail("a list's length must be of an integer type");
  }
  property.type = read_type(lines);
  property.name = lines.rest();
  while (!property.name.empty() && property.name.back() == ' ') property.name.pop_back();
  if (property.name.empty()) lines.fail("the property has no name");
  return property;
}

PlyEncoding read_encoding(TextLines& lines) {
  const std::string word(lines.word().substr(0, 40));
  const std::string version(lines.word().substr(0, 40));
  if (version != "1.0") lines.fail("version '" + version + "' is unknown; 1.0 is read");
  if (word == "ascii") return PlyEncoding::text;
  if (word == "binary_little_endian") return PlyEncoding::little_endian;
  if (word == "binary_big_endian") return PlyEncoding::big_endian;
  lines.fail("the format '" + word + "' is unknown");
}

PlyElement read_element(TextLines& lines, std::set<std::string>& names) {
  PlyElement element;
  element.name = lines.word();
  element.count = lines.integer("the number of elements");
  element.line = lines.number();
  if (element.count < 0) lines.fail("the number of elements is negative");
  if (!names.insert(element.name).second) lines.fail("the element is declared twice");
  return element;
}

}  // namespace

Index bytes_of(PlyType type) {
  constexpr std::array<Index, 8> kBytes{1, 1, 2, 2, 4, 4, 4, 8};
  return kBytes[static_cast<std::size_t>(type)];
}

bool is_integer(PlyType type) { return type < PlyType::float32; }

PlyHeader read_ply_header(TextLines& lines) {
  PlyHeader header;
  if (!lines.next() || lines.line() != "ply") {
    lines.fail("the first line is not 'ply'; is this a PLY file?");
  }
  bool has_format = false;
  std::set<std::string> elements, properties;  // their names, the latter of the latest element
  int declared = 0;
  for (;;) {
    if (!lines.next()) lines.fail("the header has no end, a line end_header; it is truncated");
    const std::string key(lines.word().substr(0, 40));
    if (key == "end_header") break;
    if (key.empty() || key == "comment" || key == "obj_info") continue;
    if (key == "format") {
      header.encoding = read_encoding(lines);
      has_format = true;
    } else if (key == "element") {
      header.elements.push_back(read_element(lines, elements));
      properties.clear();
    } else if (key == "property") {
      if (header.elements.empty()) lines.fail("a property comes before the first element");
      PlyProperty property = read_property(lines);
      if (!properties.insert(property.name).second) {
        lines.fail("the property " + property.name + " is declared twice");
      }
      if (++declared > kMostProperties) {
        lines.fail("more than " + std::to_string(kMostProperties) +
                   " properties; leave out what is not needed");
      }
      header.elements.back().properties.push_back(std::move(property));
    } else {
      lines.fail("'" + key + "' is no line of a PLY header");
    }
  }
  if (!has_format) lines.fail("the header lacks the line 'format ...'");
  return header;
}

}  // namespace dsc::detail
