// .om through OpenMesh: what om_chunks has checked is handed on, the rest is left out by name.
#include "libdsc/base/error.h"
#include "libdsc/io/mesh_formats.h"
#include "libdsc/io/om_chunks.h"
#include "libdsc/io/openmesh_io.h"
#include "libdsc/surface/surface_mesh.h"

#include <OpenMesh/Core/IO/MeshIO.hh>

#include <algorithm>
#include <array>
#include <cstring>
#include <sstream>
#include <tuple>

namespace dsc::detail {
namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

/// A type of custom property that becomes a field.
template <class T, Index parts_>
struct Kept {
  using Type = T;
  static constexpr Index parts = parts_;
};
using KeptTypes =
    std::tuple<Kept<double, 1>, Kept<float, 1>, Kept<std::int8_t, 1>, Kept<std::uint8_t, 1>,
               Kept<std::int16_t, 1>, Kept<std::uint16_t, 1>, Kept<std::int32_t, 1>,
               Kept<std::uint32_t, 1>, Kept<OpenMesh::Vec3d, 3>, Kept<OpenMesh::Vec3f, 3>>;

/// Calls use(Kept<…>()) for the type of that name, in OpenMesh's spelling. \return whether it is.
template <class Use>
bool with_kept_type(const std::string& name, Use&& use) {
  const auto attempt = [&](auto kept) {
    using T = typename decltype(kept)::Type;
    if (name != OpenMesh::IO::binary<T>::type_identifier()) return false;
    use(kept);
    return true;
  };
  return std::apply([&](auto... kept) { return (attempt(kept) || ...); }, KeptTypes());
}

/// OpenMesh finds properties by their names, its own among them: <vprop>, v:points and the like. A
/// chunk of such a name, or of none, would be read into them.
bool is_openmesh_name(const std::string& name) {
  return name.empty() || name[0] == '<' || (name.size() > 1 && name[1] == ':');
}

bool is_kept(const OmChunk& chunk, const OmFile& om) {
  if (chunk.kind == OmKind::topology) return true;
  if (chunk.kind == OmKind::position) return chunk.entity == OmEntity::vertex;
  if (chunk.kind != OmKind::custom || is_openmesh_name(chunk.name)) return false;
  if (chunk.entity != OmEntity::vertex && chunk.entity != OmEntity::face) return false;
  const Index count = chunk.entity == OmEntity::vertex ? om.vertices : om.faces;
  bool fits = false;
  with_kept_type(chunk.type, [&](auto kept) {
    using T = typename decltype(kept)::Type;
    fits = chunk.end - chunk.data == count * static_cast<Index>(sizeof(T));
  });
  return fits;
}

/// OpenMesh makes vertices of positions, edges and faces of their connectivity, and trusts that
/// they are there when it reads more about them. This is the order in which it writes them.
int place_of(const OmChunk& chunk) {
  if (chunk.kind == OmKind::custom) return 4;
  if (chunk.kind == OmKind::position) return 0;
  return chunk.entity == OmEntity::halfedge ? 1 : chunk.entity == OmEntity::vertex ? 2 : 3;
}

/// The file as OpenMesh gets it.
std::string kept_bytes(const OmBytes& file, const OmFile& om) {
  std::vector<OmChunk> kept;
  for (const OmChunk& chunk : om.chunks) {
    if (is_kept(chunk, om)) kept.push_back(chunk);
  }
  std::stable_sort(kept.begin(), kept.end(),
                   [](const OmChunk& a, const OmChunk& b) { return place_of(a) < place_of(b); });
  std::string bytes(file.bytes.substr(0, 16));
  for (const OmChunk& chunk : kept) {
    bytes += file.bytes.substr(static_cast<std::size_t>(chunk.begin),
                               static_cast<std::size_t>(chunk.end - chunk.begin));
  }
  return bytes += file.bytes.substr(file.bytes.size() - 2);
}

std::string description(const OmChunk& chunk) {
  constexpr std::array<const char*, 8> kEntities{"vertex", "mesh", "face",     "",
                                                 "edge",   "",     "halfedge", ""};
  const std::string of = kEntities[static_cast<std::size_t>(chunk.entity)];
  switch (chunk.kind) {
    case OmKind::normal:
      return of + " normals";
    case OmKind::texture:
      return of + " texture coordinates";
    case OmKind::status:
      return of + " status";
    case OmKind::colour:
      return of + " colours";
    default:
      return of + " property '" + chunk.name + "'";
  }
}

/// The corners of every face, by its loop of halfedges.
void read_corners(const SurfaceMesh& mesh, const OmBytes& file, PolygonMesh& result) {
  result.offsets.push_back(0);
  for (int f = 0; f < static_cast<int>(mesh.n_faces()); ++f) {
    const HalfedgeHandle start = mesh.halfedge_handle(FaceHandle(f));
    HalfedgeHandle h = start;
    std::size_t length = 0;
    do {
      if (mesh.face_handle(h).idx() != f || ++length > mesh.n_halfedges()) {
        file.fail(0, "face " + std::to_string(f) + " is no loop of edges; the file is damaged");
      }
      result.corners.push_back(mesh.to_vertex_handle(h).idx());
      h = mesh.next_halfedge_handle(h);
    } while (h != start);
    if (length < 3) {
      file.fail(0, "face " + std::to_string(f) + " has fewer than 3 corners; remove it");
    }
    result.offsets.push_back(std::ssize(result.corners));
  }
}

/// Gathers what a halfedge mesh had to split. \return per vertex id a mesh vertex.
std::vector<int> glue(const SurfaceMesh& mesh, const OmBytes& file, PolygonMesh& result) {
  std::vector<int> source;
  OpenMesh::VPropHandleT<int> ids;
  if (!mesh.get_property_handle(ids, property::kVertexId)) {
    for (int v = 0; v < static_cast<int>(mesh.n_vertices()); ++v) source.push_back(v);
    return source;
  }
  const auto n = static_cast<int>(mesh.n_vertices());
  const auto id_of = [&](int v) { return mesh.property(ids, VertexHandle(v)); };
  source.assign(static_cast<std::size_t>(n), -1);
  int greatest = -1;
  for (int v = n - 1; v >= 0; --v) {
    if (id_of(v) < 0 || id_of(v) >= n) {
      file.fail(0, "vertex " + std::to_string(v) + ": its id " + std::to_string(id_of(v)) +
                       " in dsc:vertex is not one of " + std::to_string(n));
    }
    source[static_cast<std::size_t>(id_of(v))] = v;
    greatest = std::max(greatest, id_of(v));
  }
  source.resize(static_cast<std::size_t>(greatest) + 1);
  for (std::size_t id = 0; id < source.size(); ++id) {
    if (source[id] < 0)
      file.fail(0, "no vertex has the id " + std::to_string(id) + " in dsc:vertex");
  }
  for (VertexId& corner : result.corners) corner = id_of(corner);
  return source;
}

template <class T>
void append_values(std::vector<double>& out, const T& value) {
  if constexpr (std::is_arithmetic_v<T>) {
    out.push_back(static_cast<double>(value));
  } else {
    for (int k = 0; k < 3; ++k) out.push_back(static_cast<double>(value[k]));
  }
}

/// The property of one chunk as a field.
void add_field(const SurfaceMesh& mesh, const OmChunk& chunk, const std::vector<int>& source,
               PolygonMesh& result, const Context& context) {
  if (chunk.name == property::kVertexId && chunk.entity == OmEntity::vertex) return;
  with_kept_type(chunk.type, [&](auto kept) {
    using T = typename decltype(kept)::Type;
    MeshField field;
    field.name = chunk.name == property::kNormal ? "normal" : chunk.name;
    field.parts = kept.parts == 3 ? vector_parts(field.name) : std::vector{field.name};
    const auto room_for = [&](std::size_t count) {
      context.need("read", static_cast<Index>(8 * count * field.parts.size()));
      field.values.reserve(count * field.parts.size());
    };
    if (chunk.entity == OmEntity::vertex) {
      field.on = FieldOn::vertex;
      OpenMesh::VPropHandleT<T> handle;
      if (!mesh.get_property_handle(handle, chunk.name)) return;
      room_for(source.size());
      for (const int v : source)
        append_values(field.values, mesh.property(handle, VertexHandle(v)));
    } else {
      field.on = FieldOn::face;
      OpenMesh::FPropHandleT<T> handle;
      if (!mesh.get_property_handle(handle, chunk.name)) return;
      room_for(mesh.n_faces());
      for (int f = 0; f < static_cast<int>(mesh.n_faces()); ++f) {
        append_values(field.values, mesh.property(handle, FaceHandle(f)));
      }
    }
    result.fields.push_back(std::move(field));
  });
}

}  // namespace

PolygonMesh parse_om(const OmBytes& file, const Context& context) {
  const OmFile om = find_om_chunks(file);
  PolygonMesh result;
  for (const OmChunk& chunk : om.chunks) {
    if (!is_kept(chunk, om)) {
      result.remarks.push_back("the " + description(chunk) + " were left out");
    }
  }

  SurfaceMesh mesh;
  {
    const OpenMeshIo io;
    std::istringstream stream(kept_bytes(file, om));
    OpenMesh::IO::Options options;
    if (om.vertices > 0 && !OpenMesh::IO::read_mesh(mesh, stream, ".om", options)) {
      file.fail(0, "OpenMesh cannot read the file");
    }
  }
  if (static_cast<Index>(mesh.n_vertices()) != om.vertices ||
      static_cast<Index>(mesh.n_faces()) != om.faces) {
    file.fail(0, "OpenMesh reads " + std::to_string(mesh.n_vertices()) + " vertices and " +
                     std::to_string(mesh.n_faces()) + " faces of the " +
                     std::to_string(om.vertices) + " and " + std::to_string(om.faces) +
                     " that the file promises");
  }
  read_corners(mesh, file, result);
  const std::vector<int> source = glue(mesh, file, result);
  result.positions.resize(3, std::ssize(source));
  for (Index v = 0; v < result.positions.cols(); ++v) {
    const auto& p = mesh.point(VertexHandle(source[static_cast<std::size_t>(v)]));
    result.positions.col(v) = Vec3(p[0], p[1], p[2]);
    if (!result.positions.col(v).allFinite()) {
      file.fail(0, "the position of vertex " + std::to_string(v) + " is not finite");
    }
  }
  for (const OmChunk& chunk : om.chunks) {
    if (chunk.kind == OmKind::custom && is_kept(chunk, om)) {
      context.check();
      add_field(mesh, chunk, source, result, context);
    }
  }
  return result;
}

PolygonMesh read_om(InputFile& file, const Context& context) {
  context.check();
  // The bytes, those of them that are kept, OpenMesh's mesh and ours: 5 bytes for one of the file.
  context.need("read", 5 * file.size());
  std::string bytes(static_cast<std::size_t>(file.size()), '\0');
  file.read(bytes.data(), file.size());
  context.advance(file.size());
  return parse_om({bytes, file.path()}, context);
}

}  // namespace dsc::detail
