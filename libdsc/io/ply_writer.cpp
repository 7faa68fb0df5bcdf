// Stanford's PLY, binary: a text header that names the properties, then the vertices one after
// another, then the faces.
#include "libdsc/io/atomic_file.h"
#include "libdsc/io/result_writers.h"

#include <algorithm>

namespace dsc::detail {
namespace {

constexpr Index kGrain = 1 << 13;

/// The values of every field of one kind at one element, in the order of the header.
void append_fields(std::string& out, const Result& result, FieldOn on, Index element) {
  for (const Field& field : result.fields) {
    if (field.on != on) continue;
    const std::size_t parts = field.parts.size();
    out.append(
        reinterpret_cast<const char*>(&field.values[static_cast<std::size_t>(element) * parts]),
        parts * sizeof(double));
  }
}

void declare_fields(std::string& header, const Result& result, FieldOn on) {
  for (const Field& field : result.fields) {
    if (field.on != on) continue;
    for (const std::string& part : field.parts) header += "property double " + part + "\n";
  }
}

/// The corner count is one byte, as every reader expects, unless a face has more than 255 corners.
bool counts_fit_a_byte(const FlatMesh& mesh) {
  for (Index f = 0; f < mesh.faces(); ++f) {
    if (mesh.first_corner(f + 1) - mesh.first_corner(f) > 255) return false;
  }
  return true;
}

}  // namespace

void write_ply(AtomicFile& file, const Result& result, const Context& context) {
  const FlatMesh& mesh = result.mesh;
  const bool bytes = counts_fit_a_byte(mesh);
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment written by libdsc\n";
  header += "element vertex " + std::to_string(mesh.vertices()) + "\n";
  header += "property double x\nproperty double y\nproperty double z\n";
  declare_fields(header, result, FieldOn::vertex);
  header += "element face " + std::to_string(mesh.faces()) + "\n";
  header += std::string("property list ") + (bytes ? "uchar" : "int") + " int vertex_indices\n";
  declare_fields(header, result, FieldOn::face);
  header += "end_header\n";
  file.write(header.data(), header.size());

  const auto vertices = [&](Index first, Index last, std::string& out) {
    for (Index v = first; v < last; ++v) {
      out.append(reinterpret_cast<const char*>(mesh.positions.data + 3 * v), 3 * sizeof(double));
      append_fields(out, result, FieldOn::vertex, v);
    }
  };
  const auto faces = [&](Index first, Index last, std::string& out) {
    for (Index f = first; f < last; ++f) {
      const std::span<const VertexId> corners = mesh.face(f);
      if (bytes) {
        append_bytes(out, static_cast<std::uint8_t>(corners.size()));
      } else {
        append_bytes(out, static_cast<std::int32_t>(corners.size()));
      }
      out.append(reinterpret_cast<const char*>(corners.data()), corners.size_bytes());
      append_fields(out, result, FieldOn::face, f);
    }
  };
  write_in_chunks(file, mesh.vertices(), kGrain, vertices, context);
  write_in_chunks(file, mesh.faces(), kGrain, faces, context);
}

}  // namespace dsc::detail
