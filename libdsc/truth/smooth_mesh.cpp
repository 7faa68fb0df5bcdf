#include "libdsc/truth/smooth_mesh.h"

#include "libdsc/base/error.h"
#include "libdsc/base/parallel.h"
#include "libdsc/truth/digital_topology.h"
#include "libdsc/truth/snap.h"
#include "libdsc/truth/surface_mesher.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace dsc::truth {
namespace {

struct Topology {
  Index components;
  Index euler;
  double gridstep;
};

/// Below this cosine a triangle of a coarse mesh bends too far to be cut: about 45 degrees.
constexpr double kCoarseCosine = 0.7;

double worst_cosine(const ImplicitShape& shape, const TriangleMesh& mesh, const Context& context) {
  return parallel_reduce(
      context, mesh.face_count(), 1024, 1.,
      [&](Index first, Index last) {
        double worst = 1.;
        for (Index f = first; f < last; ++f) {
          const Vec3 area = mesh.area_vector(f);
          for (int k = 0; k < 3; ++k) {
            const Vec3 g = shape.gradient(mesh.corner(f, k));
            const double lengths = area.norm() * g.norm();
            worst = std::min(worst, lengths > 0 ? area.dot(g) / lengths : -1.);
          }
        }
        return worst;
      },
      [](double a, double b) { return std::min(a, b); });
}

/// The mesh measured, and why it is not what smooth_mesh.h guarantees; empty where it is.
std::string measure(const ImplicitShape& shape, const Topology& wanted, SmoothMesh& result,
                    const Context& context) {
  result.counts = count(result.mesh);
  result.edges = edge_lengths(result.mesh);
  result.gridstep = wanted.gridstep;
  const TriangleMeshCounts& counts = result.counts;
  if (!counts.closed_manifold()) {
    return fmt::format(
        "it has {} boundary, {} non-manifold and {} misoriented edges, {} pinched vertices",
        counts.boundary_edges, counts.nonmanifold_edges, counts.misoriented_edges,
        counts.pinched_vertices);
  }
  if (counts.components != wanted.components || counts.euler != wanted.euler) {
    return fmt::format(
        "it has {} components and Euler number {}, the digitization at gridstep {} has {} and {}",
        counts.components, counts.euler, wanted.gridstep, wanted.components, wanted.euler);
  }
  result.worst_cosine = worst_cosine(shape, result.mesh, context);
  if (!(result.worst_cosine > 0)) return "a triangle faces away from the surface's normal";
  return {};
}

void check_in_bounds(const ImplicitShape& shape, const TriangleMesh& mesh) {
  const Eigen::AlignedBox3d box = shape.bounds();
  const Vec3 slack = Vec3::Constant(1e-9 * box.diagonal().norm());
  const Eigen::AlignedBox3d allowed(box.min() - slack, box.max() + slack);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 p = mesh.vertices.col(v);
    if (!allowed.contains(p)) {
      throw InputError(fmt::format(
          "smooth mesh: the surface of {} leaves its box at ({}, {}, {}); choose a larger box",
          shape.name(), p.x(), p.y(), p.z()));
    }
  }
}

/// Cut in four, new vertices snapped; nothing where a vertex does not reach the surface.
std::optional<TriangleMesh> cut(const ImplicitShape& shape, const TriangleMesh& coarse,
                                double longest, const Context& context) {
  TriangleMesh fine = subdivide(coarse);
  if (snap_to_surface(shape, 0.5 * longest, coarse.vertex_count(), fine.vertices, context) > 0) {
    return std::nullopt;
  }
  return fine;
}

/// What the mesher starts from, and how close its triangles come to the surface.
struct Density {
  double seed_spacing;
  double distance;
};

/// Meshed at edge_length 2^cuts, then cut; `reason` tells why where that fails.
std::optional<SmoothMesh> attempt(const ImplicitShape& shape, const DigitalTopology& digital,
                                  double edge_length, int cuts, const Density& density,
                                  std::string& reason, const Context& context) {
  const Topology wanted{digital.components, digital.euler, digital.gridstep};
  const double edge = std::ldexp(edge_length, cuts);
  SmoothMesh result;
  const Eigen::Matrix3Xd seeds = surface_seeds(shape, digital, density.seed_spacing);
  if (seeds.cols() == 0) {
    throw InputError("smooth mesh: Newton's method finds no point of the surface of " +
                     shape.name());
  }
  result.mesh = detail::mesh_surface(shape, {seeds.data(), seeds.cols()}, edge, density.distance);
  context.check();
  if (snap_to_surface(shape, 0.5 * edge, 0, result.mesh.vertices, context) > 0) {
    reason = "Newton's method does not reach the surface from a vertex";
    return std::nullopt;
  }
  check_in_bounds(shape, result.mesh);
  orient(result.mesh, [&](const Vec3& p) { return shape.gradient(p); });
  reason = measure(shape, wanted, result, context);
  if (!reason.empty()) return std::nullopt;
  if (cuts == 0) return result;
  if (result.worst_cosine < kCoarseCosine) {
    reason = "it is too coarse to be cut";
    return std::nullopt;
  }
  for (int k = 0; k < cuts; ++k) {
    std::optional<TriangleMesh> fine =
        cut(shape, result.mesh, std::ldexp(result.edges.longest, -k), context);
    if (!fine) {
      reason = "Newton's method does not reach the surface from the middle of an edge";
      return std::nullopt;
    }
    result.mesh = std::move(*fine);
    context.check();
  }
  result.cuts = cuts;
  check_in_bounds(shape, result.mesh);
  reason = measure(shape, wanted, result, context);
  if (!reason.empty()) return std::nullopt;
  return result;
}

}  // namespace

SmoothMesh smooth_mesh(const ImplicitShape& shape, const SmoothMeshOptions& options,
                       const Context& context) {
  const double e = options.edge_length;
  if (!(e > 0) || !std::isfinite(e)) {
    throw UsageError(fmt::format("smooth mesh: edge_length must be positive, not {}", e));
  }
  context.begin("smooth mesh");
  const double extent = shape.bounds().sizes().maxCoeff();
  int cuts = 0;
  while (std::ldexp(e, cuts + 1) <= extent / 8.) ++cuts;
  const DigitalTopology digital = digital_topology(shape, context);
  const double h = 0.5 * digital.gridstep;
  // Surfels have about 1.5 times the area of what they stand for.
  const double area = static_cast<double>(digital.surface.face_count()) * h * h / 1.5;
  // A mesh of this kind has about 1.5 vertices for each triangle of the bound's size.
  const double expected = 1.5 * area / (std::sqrt(3.) / 2. * e * e);
  if (expected > static_cast<double>(options.max_vertices)) {
    throw LimitError(fmt::format(
        "smooth mesh: {} at edge length {} has about {:.0f} vertices, more than {}; choose longer "
        "edges",
        shape.name(), e, expected, options.max_vertices));
  }
  std::string reason;
  for (; cuts > 0; --cuts) {
    context.check();
    const double edge = std::ldexp(e, cuts);
    auto result = attempt(shape, digital, e, cuts, {2. * edge, 0.1 * edge}, reason, context);
    if (result) return std::move(*result);
  }
  // Where two sheets are close, the mesher tells them apart only if it starts from points closer
  // than they are; where the surface bends within an edge, triangles must be smaller.
  for (double part = 1.; part > 0.03; part *= 0.5) {
    context.check();
    const Density density{std::max(2. * part * e, h), 0.1 * part * e};
    if (auto result = attempt(shape, digital, e, 0, density, reason, context)) {
      return std::move(*result);
    }
  }
  throw SolverError(fmt::format(
      "smooth mesh: the mesh of {} at edge length {} is not its surface: {}; choose shorter edges",
      shape.name(), e, reason));
}

SmoothMesh refine(const ImplicitShape& shape, const SmoothMesh& coarse, const Context& context) {
  SmoothMesh fine;
  std::optional<TriangleMesh> mesh = cut(shape, coarse.mesh, coarse.edges.longest, context);
  std::string reason = "Newton's method does not reach the surface from the middle of an edge";
  if (mesh) {
    fine.mesh = std::move(*mesh);
    fine.cuts = coarse.cuts + 1;
    check_in_bounds(shape, fine.mesh);
    reason = measure(shape, {coarse.counts.components, coarse.counts.euler, coarse.gridstep}, fine,
                     context);
  }
  if (!reason.empty()) {
    throw SolverError("smooth mesh: cut in four, the mesh of " + shape.name() +
                      " is no longer its surface: " + reason + "; choose shorter edges");
  }
  return fine;
}

}  // namespace dsc::truth
