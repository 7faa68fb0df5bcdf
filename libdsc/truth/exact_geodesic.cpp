#include "libdsc/truth/exact_geodesic.h"

#include "libdsc/base/error.h"
#include "libdsc/solve/components.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <string>

namespace dsc::truth {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Traits = CGAL::Surface_mesh_shortest_path_traits<Kernel, CgalMesh>;
using ShortestPath = CGAL::Surface_mesh_shortest_path<Traits>;

/// The mesh with a vertex more, at a point on an edge.
TriangleMesh with_vertex(const TriangleMesh& mesh, const MeshPoint& on_edge,
                         const std::vector<VertexId>& ends) {
  TriangleMesh result;
  const auto added = static_cast<VertexId>(mesh.vertex_count());
  result.vertices.resize(3, mesh.vertex_count() + 1);
  result.vertices << mesh.vertices, on_edge.point;
  for (const Triangle& t : mesh.faces) {
    const auto a = std::find(t.begin(), t.end(), ends[0]);
    const auto b = std::find(t.begin(), t.end(), ends[1]);
    if (a == t.end() || b == t.end()) {
      result.faces.push_back(t);
      continue;
    }
    for (const auto replaced : {a, b}) {
      Triangle half = t;
      half[static_cast<std::size_t>(replaced - t.begin())] = added;
      result.faces.push_back(half);
    }
  }
  return result;
}

/// \throws InputError, LimitError as the constructor.
const TriangleMesh& checked(const TriangleMesh& mesh) {
  if (mesh.vertex_count() > kMaxGeodesicVertices) {
    throw LimitError("exact geodesics: the mesh has " + std::to_string(mesh.vertex_count()) +
                     " vertices, more than " + std::to_string(kMaxGeodesicVertices) +
                     "; choose longer edges");
  }
  const TriangleMeshCounts counts = count(mesh);
  if (!counts.oriented_manifold()) {
    throw InputError("exact geodesics: the mesh is not an oriented manifold: " +
                     std::to_string(counts.nonmanifold_edges) + " non-manifold and " +
                     std::to_string(counts.misoriented_edges) + " misoriented edges, " +
                     std::to_string(counts.pinched_vertices) + " pinched and " +
                     std::to_string(counts.unused_vertices) + " unused vertices");
  }
  return mesh;
}

}  // namespace

struct ExactGeodesic::Mesh {
  explicit Mesh(const TriangleMesh& mesh)
      : triangles(mesh),
        tree(mesh),
        component(connected_components(gathered(mesh).view()).of_vertex) {
    cgal.reserve(static_cast<CgalMesh::size_type>(mesh.vertex_count()),
                 static_cast<CgalMesh::size_type>(3 * mesh.face_count() / 2),
                 static_cast<CgalMesh::size_type>(mesh.face_count()));
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Vec3 p = mesh.vertices.col(v);
      cgal.add_vertex({p.x(), p.y(), p.z()});
    }
    for (const Triangle& t : mesh.faces) {
      const auto vertex = [](VertexId v) {
        return CgalMesh::Vertex_index(static_cast<CgalMesh::size_type>(v));
      };
      if (cgal.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2])) == CgalMesh::null_face()) {
        throw InputError("exact geodesics: CGAL's mesh does not take a triangle");
      }
    }
  }

  /// CGAL counts a face's coordinates from the source of its halfedge.
  ShortestPath::Face_location location(const MeshPoint& at) const {
    const CgalMesh::Face_index face(static_cast<CgalMesh::size_type>(at.face));
    const auto first = static_cast<VertexId>(cgal.source(cgal.halfedge(face)).idx());
    const Triangle& corners = triangles.faces[static_cast<std::size_t>(at.face)];
    const auto k = std::find(corners.begin(), corners.end(), first) - corners.begin();
    return {face, {at.barycentric[k], at.barycentric[(k + 1) % 3], at.barycentric[(k + 2) % 3]}};
  }

  VertexId component_of(const MeshPoint& at) const {
    return component[static_cast<std::size_t>(
        triangles.faces[static_cast<std::size_t>(at.face)][0])];
  }

  /// The vertices that a point lies between: one, two or three.
  std::vector<VertexId> support(const MeshPoint& at) const {
    std::vector<VertexId> vertices;
    for (int k = 0; k < 3; ++k) {
      if (at.barycentric[k] > 0) {
        vertices.push_back(
            triangles.faces[static_cast<std::size_t>(at.face)][static_cast<std::size_t>(k)]);
      }
    }
    return vertices;
  }

  /// The triangles that a point is on: two where it lies on an edge, all around a vertex.
  std::vector<Triangle> triangles_at(const MeshPoint& at) const {
    const std::vector<VertexId> vertices = support(at);
    std::vector<Triangle> found;
    for (const Triangle& t : triangles.faces) {
      if (has_all(t, vertices)) found.push_back(t);
    }
    return found;
  }

  static bool has_all(const Triangle& t, const std::vector<VertexId>& vertices) {
    return std::all_of(vertices.begin(), vertices.end(),
                       [&](VertexId v) { return std::find(t.begin(), t.end(), v) != t.end(); });
  }

  Eigen::VectorXd distances(const MeshPoint& from, Vec3View queries, const Context& context) const;

  TriangleMesh triangles;
  MeshTree tree;
  std::vector<VertexId> component;
  CgalMesh cgal;
};

ExactGeodesic::ExactGeodesic(const TriangleMesh& mesh)
    : mesh_(std::make_unique<Mesh>(checked(mesh))) {}
ExactGeodesic::ExactGeodesic(ExactGeodesic&&) noexcept = default;
ExactGeodesic& ExactGeodesic::operator=(ExactGeodesic&&) noexcept = default;
ExactGeodesic::~ExactGeodesic() = default;

Eigen::VectorXd ExactGeodesic::distances(const Vec3& source, Vec3View queries,
                                         const Context& context) const {
  context.begin("exact geodesics", queries.size);
  const MeshPoint from = mesh_->tree.closest(source);
  const std::vector<VertexId> support = mesh_->support(from);
  if (support.size() != 2) return mesh_->distances(from, queries, context);
  // From a source on an edge, CGAL 5.5 finds paths shorter than the straight line: make it a
  // vertex.
  const Mesh split(with_vertex(mesh_->triangles, from, support));
  return split.distances(split.tree.closest(from.point), queries, context);
}

Eigen::VectorXd ExactGeodesic::Mesh::distances(const MeshPoint& from, Vec3View queries,
                                               const Context& context) const {
  const std::vector<Triangle> around = triangles_at(from);
  Eigen::VectorXd result(queries.size);
  try {
    ShortestPath paths(cgal);
    paths.add_source_point(location(from));
    paths.build_sequence_tree();
    for (Index i = 0; i < queries.size; ++i) {
      if (i % 1024 == 0) context.check();
      context.advance(1);
      const MeshPoint to = tree.closest(queries[i]);
      if (component_of(to) != component_of(from)) {
        result[i] = std::numeric_limits<double>::infinity();
        continue;
      }
      const double straight = (to.point - from.point).norm();
      // In one triangle with the source it is the shortest path.
      const std::vector<VertexId> between = support(to);
      if (std::any_of(around.begin(), around.end(),
                      [&](const Triangle& t) { return has_all(t, between); })) {
        result[i] = straight;
        continue;
      }
      const ShortestPath::Face_location at = location(to);
      result[i] = paths.shortest_distance_to_source_points(at.first, at.second).first;
      // No path along the mesh is shorter than the straight line, up to rounding.
      if (!(result[i] >= straight * (1. - 1e-9))) {
        throw SolverError("exact geodesics: CGAL's distance to query " + std::to_string(i) +
                          " is " + std::to_string(result[i]) + ", the straight line " +
                          std::to_string(straight));
      }
    }
  } catch (const Error&) {
    throw;
  } catch (const std::exception& e) {
    throw SolverError(std::string("exact geodesics: CGAL failed: ") + e.what());
  }
  return result;
}

}  // namespace dsc::truth
