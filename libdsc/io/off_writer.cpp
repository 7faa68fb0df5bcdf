// Geomview's OFF, text: no comment, which OpenMesh's reader would not take for one.
#include "libdsc/io/atomic_file.h"
#include "libdsc/io/result_writers.h"

namespace dsc::detail {

void write_off(AtomicFile& file, const Result& result, const Context& context) {
  constexpr Index kGrain = 1 << 13;
  const FlatMesh& mesh = result.mesh;
  file.write("OFF\n" + std::to_string(mesh.vertices()) + " " + std::to_string(mesh.faces()) +
             " 0\n");
  const auto vertices = [&](Index first, Index last, std::string& out) {
    for (Index v = first; v < last; ++v) {
      append_numbers(out, mesh.positions[v]);
      out += '\n';
    }
  };
  const auto faces = [&](Index first, Index last, std::string& out) {
    for (Index f = first; f < last; ++f) {
      const auto corners = mesh.face(f);
      append_number(out, static_cast<Index>(corners.size()));
      for (const VertexId v : corners) {
        out += ' ';
        append_number(out, v);
      }
      out += '\n';
    }
  };
  write_in_chunks(file, mesh.vertices(), kGrain, vertices, context);
  write_in_chunks(file, mesh.faces(), kGrain, faces, context);
}

}  // namespace dsc::detail
