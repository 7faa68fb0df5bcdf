#include "libdsc/truth/mesh_tree.h"

#include "libdsc/base/error.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>

namespace dsc::truth {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using BoxTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 to_cgal(const Vec3& p) { return {p.x(), p.y(), p.z()}; }
Vec3 from_cgal(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

/// Barycentric coordinates of q, a point of the triangle up to rounding. Coordinates below
/// 1e-9 become zero, so that points on edges and at vertices are known as such.
Vec3 barycentric_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& q) {
  const Vec3 n = (b - a).cross(c - a);
  Vec3 w((c - b).cross(q - b).dot(n), (a - c).cross(q - c).dot(n), (b - a).cross(q - a).dot(n));
  w /= n.squaredNorm();
  w = (w.array() < 1e-9).select(0., w);
  return w / w.sum();
}

}  // namespace

struct MeshTree::Tree {
  Triangles triangles;
  std::vector<Index> faces;
  BoxTree tree;
};

MeshTree::MeshTree(const TriangleMesh& mesh) : tree_(std::make_unique<Tree>()) {
  if (!mesh.vertices.allFinite()) throw InputError("closest points: a vertex is not finite");
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Vec3 a = mesh.corner(f, 0);
    const Vec3 b = mesh.corner(f, 1);
    const Vec3 c = mesh.corner(f, 2);
    const double longest =
        std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    if (!(mesh.area_vector(f).norm() > 1e-12 * longest)) continue;
    tree_->triangles.emplace_back(to_cgal(a), to_cgal(b), to_cgal(c));
    tree_->faces.push_back(f);
  }
  if (tree_->triangles.empty()) {
    throw InputError("closest points: no triangle of the mesh has an area");
  }
  tree_->tree.insert(tree_->triangles.cbegin(), tree_->triangles.cend());
  // Now, not at the first query, which may come from several threads.
  tree_->tree.build();
  tree_->tree.accelerate_distance_queries();
}

MeshTree::MeshTree(MeshTree&&) noexcept = default;
MeshTree& MeshTree::operator=(MeshTree&&) noexcept = default;
MeshTree::~MeshTree() = default;

MeshPoint MeshTree::closest(const Vec3& p) const {
  if (!p.allFinite()) throw InputError("closest points: a point is not finite");
  const auto [point, triangle] = tree_->tree.closest_point_and_primitive(to_cgal(p));
  const Vec3 a = from_cgal(triangle->vertex(0));
  const Vec3 b = from_cgal(triangle->vertex(1));
  const Vec3 c = from_cgal(triangle->vertex(2));
  MeshPoint result;
  result.face = tree_->faces[static_cast<std::size_t>(triangle - tree_->triangles.cbegin())];
  result.barycentric = barycentric_of(a, b, c, from_cgal(point));
  result.point = result.barycentric[0] * a + result.barycentric[1] * b + result.barycentric[2] * c;
  return result;
}

}  // namespace dsc::truth
