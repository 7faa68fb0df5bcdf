#include "libdsc/solve/checkerboard.h"

#include "libdsc/base/error.h"
#include "libdsc/calculus/mesh_checks.h"
#include "libdsc/calculus/polygon_kernel.h"

#include <array>
#include <string>
#include <vector>

namespace dsc {
namespace {

constexpr std::array<double, 4> kAlternating{1, -1, 1, -1};

/// V × K: which class a vertex is in.
SparseMatrix indicator(const Components& classes) {
  const auto n = static_cast<Eigen::Index>(classes.of_vertex.size());
  std::vector<Eigen::Triplet<double>> ones;
  for (Eigen::Index v = 0; v < n; ++v) {
    ones.emplace_back(static_cast<int>(v), classes.of_vertex[static_cast<std::size_t>(v)], 1.);
  }
  SparseMatrix result(n, classes.count());
  result.setFromTriplets(ones.begin(), ones.end());
  return result;
}

/// The connected components of the surface, as sets of classes.
Components of_classes(const Components& components, const Components& classes) {
  Components result;
  for (const VertexId v : classes.lowest) {
    const VertexId c = components.of_vertex[static_cast<std::size_t>(v)];
    if (c == static_cast<VertexId>(result.lowest.size())) {
      result.lowest.push_back(static_cast<VertexId>(result.of_vertex.size()));
    }
    result.of_vertex.push_back(c);
  }
  return result;
}

}  // namespace

Components kernel_classes(const FlatMesh& mesh, Stabilization stabilization) {
  if (stabilization != Stabilization::mercat) return connected_components(mesh);
  // A quad becomes its two diagonals, a triangle two of its sides.
  std::vector<VertexId> corners;
  std::vector<Index> offsets{0};
  for (Index f = 0; f < mesh.faces(); ++f) {
    const auto face = mesh.face(f);
    if (face.size() > 4) {
      throw UsageError(face_name(mesh, f) + " has " + std::to_string(face.size()) +
                       " corners: with Stabilization::mercat the kernel of the Laplacian is known "
                       "on triangles and quads only; choose another");
    }
    const bool quad = face.size() == 4;
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
      corners.push_back(face[i]);
      corners.push_back(face[quad ? i + 2 : i + 1]);
      offsets.push_back(static_cast<Index>(corners.size()));
    }
  }
  FlatMesh joined;
  joined.positions = mesh.positions;
  joined.corners = corners;
  joined.offsets = offsets;
  return connected_components(joined);
}

SparseMatrix checkerboard_form(const FlatMesh& mesh, const CalculusOptions& options,
                               const Context& context) {
  options.check();
  check_mesh(mesh, options);
  context.begin("checkerboards");
  PolygonKernel kernel(mesh, options);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(16 * mesh.faces()));
  for (Index f = 0; f < mesh.faces(); ++f) {
    kernel.load(f);
    const auto face = mesh.face(f);
    if (face.size() != 4) continue;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        entries.emplace_back(face[i], face[j],
                             kernel.area() / 16. * kAlternating[i] * kAlternating[j]);
      }
    }
  }
  SparseMatrix S(mesh.vertices(), mesh.vertices());
  S.setFromTriplets(entries.begin(), entries.end());
  return S;
}

CheckerboardFilter::CheckerboardFilter(const FlatMesh& mesh, const CalculusOptions& options,
                                       const Context& context)
    : components_(connected_components(mesh)),
      classes_(kernel_classes(mesh, Stabilization::mercat)) {
  S_ = checkerboard_form(mesh, options, context);
  const SparseMatrix of = indicator(classes_);
  const SparseMatrix between = of.transpose() * S_ * of;
  between_.emplace(between, of_classes(components_, classes_).lowest, SolverOptions{}, context);
}

void CheckerboardFilter::remove(Eigen::VectorXd& x, const Eigen::VectorXd& mass) const {
  const auto n = static_cast<Index>(classes_.of_vertex.size());
  if (x.size() != n || mass.size() != n) {
    throw UsageError("checkerboards: " + std::to_string(x.size()) + " values and " +
                     std::to_string(mass.size()) + " masses for " + std::to_string(n) +
                     " vertices");
  }
  const Eigen::VectorXd before = component_means(components_, mass, x);
  const Eigen::VectorXd force = S_ * x;
  Eigen::VectorXd of_class = Eigen::VectorXd::Zero(classes_.count());
  for (Index v = 0; v < n; ++v)
    of_class[classes_.of_vertex[static_cast<std::size_t>(v)]] -= force[v];
  const Eigen::VectorXd constants =
      between_->solve(of_class, Eigen::VectorXd::Zero(classes_.count())).x;
  for (Index v = 0; v < n; ++v) x[v] += constants[classes_.of_vertex[static_cast<std::size_t>(v)]];
  const Eigen::VectorXd shift = before - component_means(components_, mass, x);
  for (Index v = 0; v < n; ++v) x[v] += shift[components_.of_vertex[static_cast<std::size_t>(v)]];
}

}  // namespace dsc
