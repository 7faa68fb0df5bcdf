// Text: a header line, then one row an element. std::to_chars gives the shortest digits that read
// back to the same bits.
#include "libdsc/io/atomic_file.h"
#include "libdsc/io/result_writers.h"

namespace dsc::detail {
namespace {

constexpr Index kGrain = 1 << 12;

Vec3 mean_corner(const FlatMesh& mesh, Index face) {
  Vec3 sum = Vec3::Zero();
  const std::span<const VertexId> corners = mesh.face(face);
  for (const VertexId v : corners) sum += mesh.positions[v];
  return corners.empty() ? sum : Vec3(sum / static_cast<double>(corners.size()));
}

}  // namespace

void write_csv(AtomicFile& file, const Result& result, FieldOn rows, const Context& context) {
  const FlatMesh& mesh = result.mesh;
  std::string header = "x,y,z";
  for (const Field& field : result.fields) {
    if (field.on != rows) continue;
    for (const std::string& part : field.parts) header += "," + part;
  }
  header += "\n";
  file.write(header.data(), header.size());

  const auto encode = [&](Index first, Index last, std::string& out) {
    for (Index i = first; i < last; ++i) {
      const Vec3 p = rows == FieldOn::vertex ? mesh.positions[i] : mean_corner(mesh, i);
      append_number(out, p[0]);
      for (const double coordinate : {p[1], p[2]}) {
        out += ',';
        append_number(out, coordinate);
      }
      for (const Field& field : result.fields) {
        if (field.on != rows) continue;
        const std::size_t parts = field.parts.size();
        for (const double value :
             field.values.subspan(static_cast<std::size_t>(i) * parts, parts)) {
          out += ',';
          append_number(out, value);
        }
      }
      out += '\n';
    }
  };
  const Index n = rows == FieldOn::vertex ? mesh.vertices() : mesh.faces();
  write_in_chunks(file, n, kGrain, encode, context);
}

}  // namespace dsc::detail
