// Geomview's OFF, text: a keyword, three counts, a vertex a line, a face a line. See mesh_reader.h.
#include "libdsc/base/checked.h"
#include "libdsc/io/mesh_formats.h"
#include "libdsc/io/text_lines.h"

namespace dsc::detail {
namespace {

/// What the keyword says of a vertex' line.
struct OffKind {
  bool normals = false;
  bool more = false;  ///< colours, texture coordinates
};

OffKind read_keyword(TextLines& lines) {
  OffKind kind;
  if (!lines.next_with_content()) lines.fail("the file is empty; an OFF file begins with OFF");
  const std::string keyword(lines.word());
  std::string_view prefix = keyword;
  if (!prefix.ends_with("OFF")) lines.fail("the keyword OFF is missing; is this an OFF file?");
  prefix.remove_suffix(3);
  if (prefix.starts_with("ST")) {
    kind.more = true;
    prefix.remove_prefix(2);
  }
  if (prefix.starts_with("C")) {
    kind.more = true;
    prefix.remove_prefix(1);
  }
  if (prefix.starts_with("N")) {
    kind.normals = true;
    prefix.remove_prefix(1);
  }
  if (!prefix.empty()) {
    lines.fail("'" + keyword.substr(0, 20) +
               "' is not read: save the mesh as OFF, COFF or NOFF with 3 coordinates a vertex");
  }
  if (lines.rest().starts_with("BINARY")) {
    lines.fail("binary OFF is not read: save the mesh as text OFF or as binary PLY");
  }
  return kind;
}

void read_vertices(TextLines& lines, Index count, const OffKind& kind, PolygonMesh& mesh) {
  std::vector<double> normals;
  mesh.positions.resize(3, count);
  for (Index v = 0; v < count; ++v) {
    if (!lines.next_with_content()) {
      lines.fail("the file ends after vertex " + std::to_string(v) + " of " +
                 std::to_string(count) + "; it is truncated or the counts are wrong");
    }
    for (int k = 0; k < 3; ++k) mesh.positions(k, v) = lines.finite("a coordinate");
    for (int k = 0; kind.normals && k < 3; ++k) normals.push_back(lines.real("a normal"));
    if (lines.more() && !kind.more) {
      lines.fail(
          "there is more than a vertex on the line; one vertex a line is read, and "
          "colours in COFF only");
    }
  }
  if (kind.normals) {
    mesh.fields.push_back({"normal", vector_parts("normal"), FieldOn::vertex, std::move(normals)});
  }
  if (kind.more && count > 0) {
    mesh.remarks.emplace_back("the vertices' colours and texture coordinates were left out");
  }
}

void read_faces(TextLines& lines, Index count, PolygonMesh& mesh, const Context& context) {
  const Index vertices = mesh.positions.cols();
  Index coloured = 0;
  mesh.offsets.push_back(0);
  for (Index f = 0; f < count; ++f) {
    if (!lines.next_with_content()) {
      lines.fail("the file ends after face " + std::to_string(f) + " of " + std::to_string(count) +
                 "; it is truncated or the counts are wrong");
    }
    const Index n = lines.integer("the number of corners");
    if (n < 3) lines.fail("a face has " + counted(n, "corner", "corners") + "; remove it");
    for (Index i = 0; i < n; ++i) {
      const Index v = lines.integer("a corner");
      if (v < 0 || v >= vertices) {
        lines.fail("corner " + std::to_string(v) + " is not one of the " +
                   counted(vertices, "vertex", "vertices") + ", which are counted from 0");
      }
      need_corners(mesh, context);
      mesh.corners.push_back(static_cast<VertexId>(v));
    }
    mesh.offsets.push_back(std::ssize(mesh.corners));
    if (lines.more()) ++coloured;
  }
  if (coloured > 0) {
    mesh.remarks.push_back("the colours of " + counted(coloured, "face", "faces") +
                           " were left out");
  }
}

}  // namespace

PolygonMesh read_off(InputFile& file, const Context& context) {
  TextLines lines(file, [&](Index bytes) {
    context.check();
    context.advance(bytes);
  });
  const OffKind kind = read_keyword(lines);
  if (!lines.more() && !lines.next_with_content()) {
    lines.fail("the file ends before its counts; it is truncated");
  }
  const Index vertices = lines.integer("the number of vertices");
  const Index faces = lines.integer("the number of faces");
  if (lines.more()) (void)lines.integer("the number of edges");
  // The shortest lines are "0 0 0" and "3 0 1 2".
  if (vertices < 0 || faces < 0 || vertices > file.size() / 6 + 1 || faces > file.size() / 8 + 1) {
    lines.fail(std::to_string(vertices) + " vertices and " + std::to_string(faces) +
               " faces are promised, which a file of " + std::to_string(file.size()) +
               " bytes cannot hold; it is truncated or the counts are wrong");
  }
  PolygonMesh mesh;
  checked_id(vertices, "vertices");
  context.need("read", (kind.normals ? 60 : 24) * vertices + faces_bytes(faces));
  read_vertices(lines, vertices, kind, mesh);
  read_faces(lines, faces, mesh, context);
  if (lines.next_with_content()) {
    lines.fail("the file goes on after its last face; are the counts right?");
  }
  lines.remark_unended_number(mesh.remarks);
  return mesh;
}

}  // namespace dsc::detail
