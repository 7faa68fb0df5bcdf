// STL, binary: floats, triangles only (face_triangles.h), vertices repeated in each.
#include "libdsc/base/error.h"
#include "libdsc/io/atomic_file.h"
#include "libdsc/io/result_writers.h"
#include "libdsc/surface/face_triangles.h"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

namespace dsc::detail {
namespace {

void append_triangle(std::string& out, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 across = (b - a).cross(c - a);
  const double length = across.norm();
  const Vec3 normal = length > 0 && std::isfinite(length) ? Vec3(across / length) : Vec3::Zero();
  for (const Vec3& vector : {normal, a, b, c}) {
    for (int k = 0; k < 3; ++k) append_bytes(out, static_cast<float>(vector[k]));
  }
  append_bytes(out, std::uint16_t{0});
}

void append_face(std::string& out, const FlatMesh& mesh, Index face) {
  const auto corners = mesh.face(face);
  const auto at = [&](std::size_t i) { return mesh.positions[corners[i]]; };
  for_each_triangle(mesh, face, [&](std::size_t a, std::size_t b, std::size_t c) {
    append_triangle(out, at(a), at(b), at(c));
  });
}

void check_range(const FlatMesh& mesh) {
  for (Index v = 0; v < mesh.vertices(); ++v) {
    if (!(mesh.positions[v].cwiseAbs().maxCoeff() <= std::numeric_limits<float>::max())) {
      throw InputError("the position of vertex " + std::to_string(v) +
                       " is beyond the floats that .stl holds; write another format");
    }
  }
}

}  // namespace

void write_stl(AtomicFile& file, const Result& result, const Context& context) {
  constexpr Index kGrain = 1 << 13;
  const FlatMesh& mesh = result.mesh;
  check_range(mesh);
  const Index triangles = mesh.corner_count() - 2 * mesh.faces();
  if (triangles > std::numeric_limits<std::uint32_t>::max()) {
    throw LimitError("an .stl file holds at most 4294967295 triangles; write another format");
  }
  std::string header = "binary STL written by libdsc";  // and never "solid", as text begins
  header.resize(80, ' ');
  append_bytes(header, static_cast<std::uint32_t>(triangles));
  file.write(header);
  const auto faces = [&](Index first, Index last, std::string& out) {
    for (Index f = first; f < last; ++f) append_face(out, mesh, f);
  };
  write_in_chunks(file, mesh.faces(), kGrain, faces, context);
}

}  // namespace dsc::detail
