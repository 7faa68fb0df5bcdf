#include "libdsc/truth/triangle_mesh.h"

#include "libdsc/base/checked.h"
#include "libdsc/surface/polygon_topology.h"

#include <algorithm>
#include <utility>

namespace dsc::truth {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Side 3 f + k runs from corner k of triangle f to the next. Per side the one across its edge, or
/// -1 where there is none or more than one.
std::vector<VertexId> sides_across(const TriangleMesh& mesh) {
  return linked_sides(gathered(mesh).view(), SideLinks::any);
}

Index next_corner(Index corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

VertexId vertex_of(const TriangleMesh& mesh, Index corner) {
  return mesh.faces[at(corner / 3)][at(corner % 3)];
}

}  // namespace

GatheredMesh gathered(const TriangleMesh& mesh) {
  GatheredMesh result;
  result.positions = mesh.vertices;
  result.corners.reserve(3 * mesh.faces.size());
  result.offsets.reserve(mesh.faces.size() + 1);
  result.offsets.push_back(0);
  for (const Triangle& t : mesh.faces) {
    result.corners.insert(result.corners.end(), t.begin(), t.end());
    result.offsets.push_back(static_cast<Index>(result.corners.size()));
  }
  return result;
}

TriangleMeshCounts count(const TriangleMesh& mesh) {
  const GatheredMesh polygons = gathered(mesh);
  TriangleMeshCounts counts{count_polygons(polygons.view())};
  counts.unused_vertices = count_isolated_vertices(polygons.view());
  const auto any = linked_sides(polygons.view(), SideLinks::any);
  const auto opposed = linked_sides(polygons.view(), SideLinks::opposed);
  for (std::size_t side = 0; side < any.size(); ++side) {
    if (any[side] >= 0 && opposed[side] < 0) ++counts.misoriented_edges;
  }
  counts.misoriented_edges /= 2;  // both sides were seen
  return counts;
}

void orient(TriangleMesh& mesh, const std::function<Vec3(const Vec3&)>& outward) {
  const std::vector<VertexId> links = sides_across(mesh);
  std::vector<char> turned(at(mesh.face_count()), -1);  // -1: not visited
  const auto runs_up = [&](Index corner) {
    const Triangle& t = mesh.faces[at(corner / 3)];
    const std::size_t k = at(corner % 3);
    return t[k] < t[(k + 1) % 3];
  };
  std::vector<Index> part;
  for (Index seed = 0; seed < mesh.face_count(); ++seed) {
    if (turned[at(seed)] >= 0) continue;
    part.assign(1, seed);
    turned[at(seed)] = 0;
    double flux = 0;
    for (std::size_t next = 0; next < part.size(); ++next) {
      const Index f = part[next];
      const Vec3 centroid = (mesh.corner(f, 0) + mesh.corner(f, 1) + mesh.corner(f, 2)) / 3.;
      const double through = mesh.area_vector(f).dot(outward(centroid));
      flux += turned[at(f)] != 0 ? -through : through;
      for (Index corner = 3 * f; corner < 3 * f + 3; ++corner) {
        const Index other = links[at(corner)];
        if (other < 0 || turned[at(other / 3)] >= 0) continue;
        const bool same_direction = runs_up(corner) == runs_up(other);
        turned[at(other / 3)] = static_cast<char>((turned[at(f)] != 0) != same_direction);
        part.push_back(other / 3);
      }
    }
    for (const Index f : part) {
      if ((turned[at(f)] != 0) != (flux < 0)) {
        std::swap(mesh.faces[at(f)][1], mesh.faces[at(f)][2]);
      }
    }
  }
}

TriangleMesh subdivide(const TriangleMesh& mesh) {
  const std::vector<VertexId> links = sides_across(mesh);
  const Index sides = 3 * mesh.face_count();
  std::vector<VertexId> middle(at(sides));
  TriangleMesh fine;
  fine.vertices.resize(3, mesh.vertex_count() + sides);
  fine.vertices.leftCols(mesh.vertex_count()) = mesh.vertices;
  Index vertices = mesh.vertex_count();
  for (Index side = 0; side < sides; ++side) {
    const VertexId other = links[at(side)];
    if (other >= 0 && other < side) {
      middle[at(side)] = middle[at(other)];
      continue;
    }
    fine.vertices.col(vertices) = 0.5 * (mesh.vertices.col(vertex_of(mesh, side)) +
                                         mesh.vertices.col(vertex_of(mesh, next_corner(side))));
    middle[at(side)] = checked_id(vertices++, "vertices of a subdivided mesh");
  }
  fine.vertices.conservativeResize(3, vertices);
  fine.faces.reserve(at(4 * mesh.face_count()));
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Triangle& t = mesh.faces[at(f)];
    const VertexId m0 = middle[at(3 * f)];
    const VertexId m1 = middle[at(3 * f + 1)];
    const VertexId m2 = middle[at(3 * f + 2)];
    for (const Triangle& part :
         {Triangle{t[0], m0, m2}, {m0, t[1], m1}, {m2, m1, t[2]}, {m0, m1, m2}}) {
      fine.faces.push_back(part);
    }
  }
  return fine;
}

EdgeLengths edge_lengths(const TriangleMesh& mesh) {
  EdgeLengths lengths;
  Index edges = 0;
  const std::vector<VertexId> links = sides_across(mesh);
  for (Index side = 0; side < static_cast<Index>(links.size()); ++side) {
    if (links[at(side)] >= 0 && links[at(side)] < side) continue;  // counted at the other side
    const double length = (mesh.vertices.col(vertex_of(mesh, side)) -
                           mesh.vertices.col(vertex_of(mesh, next_corner(side))))
                              .norm();
    lengths.longest = std::max(lengths.longest, length);
    lengths.mean += length;
    ++edges;
  }
  if (edges > 0) lengths.mean /= static_cast<double>(edges);
  return lengths;
}

}  // namespace dsc::truth
