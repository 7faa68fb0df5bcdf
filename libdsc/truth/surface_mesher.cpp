#include "libdsc/truth/surface_mesher.h"

#include "libdsc/base/error.h"

#include <CGAL/Complex_2_in_triangulation_3.h>
#include <CGAL/Implicit_surface_3.h>
#include <CGAL/Surface_mesh_default_criteria_3.h>
#include <CGAL/Surface_mesh_default_triangulation_3.h>
#include <CGAL/make_surface_mesh.h>

#include <cmath>
#include <exception>
#include <string>
#include <unordered_map>

namespace dsc::truth::detail {
namespace {

using Triangulation = CGAL::Surface_mesh_default_triangulation_3;
using Complex = CGAL::Complex_2_in_triangulation_3<Triangulation>;
using Kernel = Triangulation::Geom_traits;
using Point = Kernel::Point_3;
using Surface = CGAL::Implicit_surface_3<Kernel, std::function<double(Point)>>;

/// The bisection along a dual edge ends within this fraction of the bounding sphere's radius.
constexpr double kErrorBound = 1e-9;

TriangleMesh arrays_of(const Complex& complex) {
  const Triangulation& triangulation = complex.triangulation();
  std::unordered_map<Triangulation::Vertex_handle, VertexId> number;
  std::vector<Vec3> points;
  TriangleMesh mesh;
  for (auto facet = complex.facets_begin(); facet != complex.facets_end(); ++facet) {
    Triangle corners{};
    for (int k = 0; k < 3; ++k) {
      const auto vertex = facet->first->vertex(triangulation.vertex_triple_index(facet->second, k));
      const auto [entry, is_new] = number.emplace(vertex, static_cast<VertexId>(points.size()));
      if (is_new) {
        const auto& p = vertex->point();
        points.emplace_back(p.x(), p.y(), p.z());
      }
      corners[static_cast<std::size_t>(k)] = entry->second;
    }
    mesh.faces.push_back(corners);
  }
  mesh.vertices.resize(3, static_cast<Index>(points.size()));
  for (std::size_t v = 0; v < points.size(); ++v) {
    mesh.vertices.col(static_cast<Index>(v)) = points[v];
  }
  return mesh;
}

}  // namespace

TriangleMesh mesh_surface(const ImplicitShape& shape, Vec3View seeds, double edge,
                          double distance) {
  const Eigen::AlignedBox3d box = shape.bounds();
  const Vec3 centre = box.center();
  const double radius = 0.51 * box.diagonal().norm();
  const Surface surface(
      [&](const Point& p) { return shape.value(Vec3(p.x(), p.y(), p.z())); },
      Kernel::Sphere_3(Point(centre.x(), centre.y(), centre.z()), radius * radius), kErrorBound);
  Triangulation triangulation;
  Complex complex(triangulation);
  for (Index i = 0; i < seeds.size; ++i) {
    const Vec3 p = seeds[i];
    triangulation.insert(Point(p.x(), p.y(), p.z()));
  }
  const CGAL::Surface_mesh_default_criteria_3<Triangulation> criteria(30., edge / std::sqrt(3.),
                                                                      distance);
  try {
    // 0: no random starting points, the seeds are enough.
    CGAL::make_surface_mesh(complex, surface, criteria, CGAL::Manifold_tag(), 0);
  } catch (const Error&) {
    throw;  // of the shape
  } catch (const std::exception& e) {
    throw SolverError("CGAL's surface mesher failed on " + shape.name() + ": " + e.what());
  }
  return arrays_of(complex);
}

}  // namespace dsc::truth::detail
