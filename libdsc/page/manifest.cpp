#include "libdsc/page/manifest.h"

#include "libdsc/page/palettes.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace dsc::detail {
namespace {

std::string number(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

std::string triple(const Vec3& v) {
  return "[" + number(v[0]) + "," + number(v[1]) + "," + number(v[2]) + "]";
}

/// For the inside of a JSON string that is the inside of a script element.
std::string quoted(std::string_view text) {
  constexpr const char* kHex = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || c == '"' || c == '\\' || c == '<') {
      out += "\\u00";
      out += kHex[byte >> 4];
      out += kHex[byte & 15];
    } else {
      out += c;
    }
  }
  return out + "\"";
}

/// Whether the values are names of things, to be told apart and not compared in size.
bool is_labels(const Field& field) {
  return field.name.starts_with("label") && field.on == FieldOn::face && field.parts.size() == 1 &&
         std::all_of(field.values.begin(), field.values.end(), [](double value) {
           return std::abs(value) < 1 << 24 && value == std::floor(value);
         });
}

std::string json_of(const Field& field, int exponent) {
  std::string parts;
  for (const std::string& part : field.parts) parts += (parts.empty() ? "" : ",") + quoted(part);
  return "{\"name\":" + quoted(field.name) + ",\"parts\":[" + parts +
         "],\"on\":" + (field.on == FieldOn::vertex ? "\"vertex\"" : "\"face\"") +
         ",\"labels\":" + (is_labels(field) ? "true" : "false") +
         ",\"exponent\":" + std::to_string(exponent) + "}";
}

}  // namespace

Manifest manifest_of(const Result& result) {
  const FlatMesh& mesh = result.mesh;
  Manifest page;
  page.exponents.resize(result.fields.size());
  if (mesh.faces() == 0) return page;
  const Index sides = mesh.first_corner(1) - mesh.first_corner(0);
  bool same = true;
  for (Index f = 1; f < mesh.faces() && same; ++f) {
    same = mesh.first_corner(f + 1) - mesh.first_corner(f) == sides;
  }
  if (same) page.sides = static_cast<int>(sides);
  return page;
}

std::string json_of(const Manifest& page, const Result& result) {
  std::string fields, maps;
  for (std::size_t i = 0; i < result.fields.size(); ++i) {
    fields += (i > 0 ? "," : "") + json_of(result.fields[i], page.exponents[i]);
  }
  for (const Palette& palette : page_palettes()) {
    maps += (maps.empty() ? "" : ",") + std::string("{\"name\":") + quoted(palette.name) +
            ",\"diverging\":" + (palette.diverging ? "true" : "false") + ",\"rgb\":\"" +
            palette.hex + "\"}";
  }
  const FlatMesh& mesh = result.mesh;
  return "{\"title\":" + quoted(page.title) + ",\"vertices\":" + std::to_string(mesh.vertices()) +
         ",\"faces\":" + std::to_string(mesh.faces()) +
         ",\"corners\":" + std::to_string(mesh.corner_count()) +
         ",\"sides\":" + std::to_string(page.sides) +
         ",\"lattice\":" + (page.lattice ? "true" : "false") +
         ",\"origin\":" + triple(page.origin) + ",\"step\":" + triple(page.step) +
         ",\"normals\":" + (mesh.has_normals() ? "true" : "false") + ",\"fields\":[" + fields +
         "],\"colormaps\":[" + maps + "]}";
}

std::string escaped_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace dsc::detail
