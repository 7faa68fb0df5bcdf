// Wavefront's OBJ. The format has no counts; the first line, a comment, has them, and our reader
// holds a file to it.
#include "libdsc/io/atomic_file.h"
#include "libdsc/io/result_writers.h"

namespace dsc::detail {

void write_obj(AtomicFile& file, const Result& result, const Context& context) {
  constexpr Index kGrain = 1 << 13;
  const FlatMesh& mesh = result.mesh;
  file.write("# libdsc: " + std::to_string(mesh.vertices()) + " vertices, " +
             std::to_string(mesh.faces()) + " faces\n");
  const auto vertices = [&](Index first, Index last, std::string& out) {
    for (Index v = first; v < last; ++v) {
      out += "v ";
      append_numbers(out, mesh.positions[v]);
      out += '\n';
    }
  };
  const auto faces = [&](Index first, Index last, std::string& out) {
    for (Index f = first; f < last; ++f) {
      out += 'f';
      for (const VertexId v : mesh.face(f)) {
        out += ' ';
        append_number(out, Index{v} + 1);
      }
      out += '\n';
    }
  };
  write_in_chunks(file, mesh.vertices(), kGrain, vertices, context);
  write_in_chunks(file, mesh.faces(), kGrain, faces, context);
}

}  // namespace dsc::detail
