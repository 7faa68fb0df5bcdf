#include "libdsc/algorithms/regularise.h"

#include "libdsc/algorithms/regularise_energy.h"
#include "libdsc/base/error.h"
#include "libdsc/calculus/embedding.h"
#include "libdsc/calculus/mesh_checks.h"
#include "libdsc/solve/matrix_free.h"

#include <cmath>
#include <string>

namespace dsc {
namespace {

void check_number(const char* name, double value, bool zero_too) {
  if (std::isfinite(value) && (value > 0 || (zero_too && value == 0))) return;
  throw UsageError("regularise: " + std::string(name) + " = " + std::to_string(value) +
                   (zero_too ? " must be 0 or more and finite" : " must be positive and finite"));
}

void check_input(const FlatMesh& mesh) {
  check_mesh(mesh, {});
  if (!mesh.has_normals()) {
    throw UsageError("regularise: the surface has no normals; estimate them first");
  }
  for (Index f = 0; f < mesh.faces(); ++f) {
    for (const VertexId v : mesh.face(f)) check_vertex(mesh, f, v);
    if (!is_unit(mesh.normals[f])) refuse_normal(mesh, f);
  }
  if (!mesh.positions.matrix().allFinite()) {
    throw InputError("regularise: a position is not finite");
  }
}

}  // namespace

void RegulariseOptions::check() const {
  check_number("alpha", alpha, false);
  check_number("beta", beta, true);
  check_number("gamma", gamma, true);
  check_number("accuracy", accuracy, false);
}

RegularisedPositions regularise_positions(const FlatMesh& mesh, const RegulariseOptions& options,
                                          const Context& context) {
  options.check();
  check_input(mesh);
  RegularisedPositions result;
  result.positions = mesh.positions.matrix();
  const Index V = mesh.vertices();
  if (mesh.faces() == 0) return result;

  context.begin("regularise");
  // Positions and what the solver iterates with, the inverse blocks; around each vertex its
  // neighbours and corners.
  context.need("regularise", (10 * 24 + 72 + 16) * V + 64 * mesh.corner_count());
  const RegulariseEnergy energy(mesh, options, context);
  // Around one of the positions: a far origin costs no digits.
  const Vec3 origin = mesh.positions[0];
  result.positions.colwise() -= origin;
  const Eigen::VectorXd p = Eigen::Map<const Eigen::VectorXd>(result.positions.data(), 3 * V);
  MatrixFreeOptions solver;
  // |x − p̂| ≤ |A⁻¹| |residual| ≤ |residual| / α.
  solver.residual =
      options.alpha * options.accuracy * energy.mean_edge() * std::sqrt(static_cast<double>(V));
  const MatrixFreeSolution solution = solve_matrix_free(
      [&](const Eigen::VectorXd& x, Eigen::VectorXd& y) { energy.apply(x, y); },
      [&](const Eigen::VectorXd& r, Eigen::VectorXd& z) { energy.precondition(r, z); },
      options.alpha * p, p, solver, context);
  result.iterations = solution.iterations;
  const Eigen::Map<const Eigen::Matrix3Xd> moved(solution.x.data(), 3, V);
  const Eigen::VectorXd displacements = (moved - result.positions).colwise().norm();
  result.mean_displacement = displacements.mean();
  result.largest_displacement = displacements.maxCoeff();
  result.positions = moved.colwise() + origin;
  return result;
}

}  // namespace dsc
