// .om by OpenMesh's own writer: to memory first, read back and compared, then to the file; for
// OpenMesh's writer reports neither a full disk nor what it cannot hold.
#include "libdsc/base/error.h"
#include "libdsc/io/atomic_file.h"
#include "libdsc/io/om_chunks.h"
#include "libdsc/io/openmesh_io.h"
#include "libdsc/io/result_writers.h"
#include "libdsc/surface/split_mesh.h"

#include <OpenMesh/Core/IO/MeshIO.hh>

#include <algorithm>
#include <cstring>
#include <sstream>

namespace dsc::detail {
namespace {

using OpenMesh::FaceHandle;
using OpenMesh::VertexHandle;

std::mutex& io_mutex() {
  static std::mutex mutex;
  return mutex;
}

std::string property_name(const Field& field) {
  return field.on == FieldOn::face && field.name == "normal" ? property::kNormal : field.name;
}

bool is_held(const Field& field) {
  const std::size_t parts = field.parts.size();
  return (parts == 1 || parts == 3) && property_name(field).size() < 256;
}

template <class T>
T value_of(const Field& field, std::size_t element) {
  if constexpr (std::is_same_v<T, double>) {
    return field.values[element];
  } else {
    const double* v = &field.values[3 * element];
    return T(v[0], v[1], v[2]);
  }
}

/// A persistent property with the field's values; copies of a vertex get the vertex' value.
template <class T>
void add_property(SurfaceMesh& mesh, const Field& field, const std::vector<VertexId>& copied) {
  const std::string name = property_name(field);
  if (field.on == FieldOn::vertex) {
    OpenMesh::VPropHandleT<T> handle;
    mesh.add_property(handle, name);
    mesh.property(handle).set_persistent(true);
    for (std::size_t v = 0; v < copied.size(); ++v) {
      mesh.property(handle, VertexHandle(static_cast<int>(v))) =
          value_of<T>(field, static_cast<std::size_t>(copied[v]));
    }
  } else {
    OpenMesh::FPropHandleT<T> handle;
    mesh.add_property(handle, name);
    mesh.property(handle).set_persistent(true);
    for (std::size_t f = 0; f < mesh.n_faces(); ++f) {
      mesh.property(handle, FaceHandle(static_cast<int>(f))) = value_of<T>(field, f);
    }
  }
}

void add_ids(SurfaceMesh& mesh, const std::vector<VertexId>& copied) {
  OpenMesh::VPropHandleT<int> handle;
  mesh.add_property(handle, property::kVertexId);
  mesh.property(handle).set_persistent(true);
  for (std::size_t v = 0; v < copied.size(); ++v) {
    mesh.property(handle, VertexHandle(static_cast<int>(v))) = copied[v];
  }
}

std::string encode(const SurfaceMesh& mesh) {
  const OpenMeshIo io;
  std::ostringstream stream;
  if (!OpenMesh::IO::write_mesh(mesh, stream, ".om") || !stream) {
    throw OutputError("OpenMesh cannot write the mesh as .om; write .ply instead");
  }
  return std::move(stream).str();
}

bool same_bits(const double* a, const double* b, Index n) {
  return n == 0 || std::memcmp(a, b, static_cast<std::size_t>(n) * sizeof(double)) == 0;
}

/// What was written must read back to the same bits.
void verify(const std::string& bytes, const Result& result, const std::string& path) {
  const PolygonMesh back = parse_om({bytes, path});
  const FlatMesh& mesh = result.mesh;
  bool same = back.positions.cols() == mesh.vertices() &&
              same_bits(back.positions.data(), mesh.positions.data, 3 * mesh.vertices()) &&
              std::ssize(back.offsets) == mesh.faces() + 1 &&
              std::equal(back.corners.begin(), back.corners.end(), mesh.corners.begin(),
                         mesh.corners.end());
  for (Index f = 0; same && f < mesh.faces(); ++f) {
    same = back.offsets[static_cast<std::size_t>(f) + 1] == mesh.first_corner(f + 1);
  }
  for (const Field& field : result.fields) {
    if (!is_held(field)) continue;
    same = same && std::any_of(back.fields.begin(), back.fields.end(), [&](const MeshField& f) {
             return f.on == field.on && f.name == field.name &&
                    f.values.size() == field.values.size() &&
                    same_bits(f.values.data(), field.values.data(), std::ssize(f.values));
           });
  }
  if (!same) {
    throw OutputError("'" + path +
                      "': OpenMesh does not read back what it wrote; write .ply instead");
  }
}

}  // namespace

OpenMeshIo::OpenMeshIo()
    : lock_(io_mutex()), log_(omlog().is_enabled()), err_(omerr().is_enabled()) {
  omlog().disable();
  omerr().disable();
}

OpenMeshIo::~OpenMeshIo() {
  if (log_) omlog().enable();
  if (err_) omerr().enable();
}

std::vector<std::string> write_om(AtomicFile& file, const Result& result, const Context& context) {
  // OpenMesh's mesh and how it is linked, its bytes while they grow, and what they read back to.
  Index values = 0;
  for (const Field& field : result.fields) values += static_cast<Index>(field.values.size());
  context.need("write",
               160 * result.mesh.vertices() + 90 * result.mesh.corner_count() + 40 * values);
  SurfaceMesh mesh;
  std::vector<VertexId> copied;
  {
    const OpenMeshIo silence;
    copied = split_mesh(result.mesh, mesh);
  }
  context.check();
  if (static_cast<Index>(copied.size()) > result.mesh.vertices()) add_ids(mesh, copied);
  std::vector<std::string> left_out;
  for (const Field& field : result.fields) {
    if (!is_held(field)) {
      left_out.push_back(field.name);
    } else if (field.parts.size() == 1) {
      add_property<double>(mesh, field, copied);
    } else {
      add_property<OpenMesh::Vec3d>(mesh, field, copied);
    }
  }
  const std::string bytes = encode(mesh);
  verify(bytes, result, file.path());
  context.check();
  file.write(bytes);
  return left_out;
}

}  // namespace dsc::detail
