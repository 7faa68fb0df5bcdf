/// \file
/// Poisson's equation on a surface, L φ = b in weak form: b is integrated, as M0 times a density
/// is.
///
/// With values given on some vertices (Dirichlet) the others solve their equations; where there are
/// none (Neumann), φ is determined up to a constant on each component, and comes with mean zero
/// there. At the boundary of the surface the normal derivative is zero unless vertices are fixed.
///
/// With Stabilization::mercat φ is determined up to a constant on each class of vertices of
/// checkerboard.h, on most surfaces the two parities of each component: b must sum to zero on each,
/// and φ comes without checkerboards; fixed vertices must lie in every class.
#pragma once

#include "libdsc/calculus/options.h"
#include "libdsc/solve/checkerboard.h"
#include "libdsc/solve/dirichlet.h"
#include "libdsc/surface/flat_mesh.h"

#include <optional>

namespace dsc {

/// The operators, and how the system is solved.
struct PoissonOptions {
  CalculusOptions calculus;  ///< of L and M0
  SolverOptions solver;      ///< method and tolerance
  SpdSolverFactory factory;  ///< empty: make_spd_solver
};

/// Factorizes once for a surface and a set of fixed vertices.
class PoissonProblem {
 public:
  /// `fixed`: the vertices with given values; empty means Neumann. \throws UsageError where one is
  /// out of range, SolverError where a component (with mercat, a class) has none while another has,
  /// and as assemble_laplacian and kernel_classes do. The mesh is not needed afterwards.
  PoissonProblem(const FlatMesh& mesh, std::span<const VertexId> fixed,
                 const PoissonOptions& options = {}, const Context& context = {});

  /// φ for the integrated right-hand side `b` (V). `values` (V) are read at fixed vertices, and may
  /// be empty where there are none. \throws InputError where b does not sum to zero on a component
  /// (with mercat, on a class; Neumann).
  Solution solve(const Eigen::VectorXd& b, const Eigen::VectorXd& values = {},
                 const Context& context = {}) const;

  const Eigen::VectorXd& mass() const { return mass_; }  ///< the diagonal of M0
  /// Faces whose normal was tilted back (embedding.h).
  Index clamped_faces() const { return clamped_faces_; }

 private:
  Eigen::VectorXd mass_;
  Eigen::VectorXd weight_;  ///< mass, but 1 at vertices without faces
  Index clamped_faces_ = 0;
  std::optional<DirichletSolver> dirichlet_;
  std::optional<NeumannSolver> neumann_;
  std::optional<CheckerboardFilter> filter_;  ///< mercat's, where nothing is fixed
};

/// The same for a single right-hand side.
Solution solve_poisson(const FlatMesh& mesh, const Eigen::VectorXd& b,
                       std::span<const VertexId> fixed = {}, const Eigen::VectorXd& values = {},
                       const PoissonOptions& options = {}, const Context& context = {});

}  // namespace dsc
