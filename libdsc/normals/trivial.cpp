#include "libdsc/normals/trivial.h"

#include "libdsc/base/checked.h"
#include "libdsc/base/parallel.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <string>
#include <vector>

namespace dsc {
namespace {

constexpr Index kSumGrain = 1 << 13;
constexpr double kVanishing = 1e-10;  // of a unit vector: what is left is rounding

/// The faces at each vertex id, ascending: those of v are faces[offsets[v]] … faces[offsets[v +
/// 1]].
struct Incidence {
  std::vector<Index> offsets;
  std::vector<std::int32_t> faces;
};

Incidence faces_at_vertices(const FlatMesh& mesh) {
  (void)checked_id(mesh.faces(), "faces");
  Incidence at;
  at.offsets.assign(static_cast<std::size_t>(mesh.vertices() + 1), 0);
  at.faces.resize(mesh.corners.size());
  for (const VertexId v : mesh.corners) ++at.offsets[static_cast<std::size_t>(v)];
  Index sum = 0;
  for (Index& offset : at.offsets) offset = sum += offset;
  for (Index f = mesh.faces(); f-- > 0;) {
    for (const VertexId v : mesh.face(f)) {
      const Index slot = --at.offsets[static_cast<std::size_t>(v)];
      at.faces[static_cast<std::size_t>(slot)] = static_cast<std::int32_t>(f);
    }
  }
  return at;
}

Vec3 own_normal(const FlatMesh& mesh, Index f) {
  if (mesh.is_digital()) return mesh.surfels[static_cast<std::size_t>(f)].normal();
  const std::span<const VertexId> corners = mesh.face(f);
  const Vec3 origin = mesh.positions[corners[0]];
  Vec3 area = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    area += (mesh.positions[corners[i]] - origin).cross(mesh.positions[corners[i + 1]] - origin);
  }
  return area.stableNormalized();  // zero stays zero
}

}  // namespace

NormalField trivial_normals(const FlatMesh& mesh, const Context& context) {
  const Index n = mesh.faces();
  context.begin("normals", n);
  NormalField field;
  field.u.resize(3, n);
  const Incidence at = faces_at_vertices(mesh);
  field.fallbacks = parallel_reduce(
      context, n, kSumGrain, Index{0},
      [&](Index first, Index last) {
        Index fallbacks = 0;
        std::vector<std::int32_t> around;
        for (Index f = first; f < last; ++f) {
          around.clear();
          for (const VertexId v : mesh.face(f)) {
            const auto begin = at.faces.begin() + at.offsets[static_cast<std::size_t>(v)];
            const auto end = at.faces.begin() + at.offsets[static_cast<std::size_t>(v) + 1];
            around.insert(around.end(), begin, end);
          }
          std::sort(around.begin(), around.end());  // each once, and always summed in one order
          around.erase(std::unique(around.begin(), around.end()), around.end());
          Vec3 sum = Vec3::Zero();
          for (const std::int32_t g : around) sum += own_normal(mesh, g);
          const Vec3 own = own_normal(mesh, f);
          if (sum.norm() > kVanishing && (own.isZero(0) || sum.dot(own) > kVanishing)) {
            field.u.col(f) = sum.normalized();
          } else if (!own.isZero(0)) {
            field.u.col(f) = own;
            ++fallbacks;
          } else {
            throw InputError("normals: face " + std::to_string(f) +
                             " has no area and no neighbour that gives it a normal; remove it");
          }
        }
        context.advance(last - first);
        return fallbacks;
      },
      [](Index a, Index b) { return a + b; });
  return field;
}

}  // namespace dsc
