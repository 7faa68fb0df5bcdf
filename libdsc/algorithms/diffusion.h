/// \file
/// Heat diffusion on a surface: one implicit Euler step, \f$(M_0 - tL)\,u = M_0 u_0\f$.
///
/// Heat is conserved, Σ M0 u = Σ M0 u0; constants stay; u tends to the mean of each component as t
/// grows. A vertex that no face uses keeps its value. With Stabilization::mercat checkerboards stay
/// too, and half of a point source is one: diffuse smooth functions only.
#pragma once

#include "libdsc/calculus/options.h"
#include "libdsc/solve/components.h"
#include "libdsc/solve/spd_solver.h"
#include "libdsc/surface/flat_mesh.h"

namespace dsc {

struct LaplaceSystem;

/// M0 - t L of an assembled system, symmetric positive definite; rows of vertices without faces get
/// a 1 on the diagonal. \throws UsageError unless t > 0 and finite.
SparseMatrix heat_matrix(const LaplaceSystem& system, double t, const Context& context = {});

/// The operators, and how the system is solved.
struct DiffusionOptions {
  CalculusOptions calculus;  ///< of L and M0
  SolverOptions solver;      ///< method and tolerance
  SpdSolverFactory factory;  ///< empty: make_spd_solver
};

/// Factorizes once for a surface and a time step, then takes any number of steps.
class HeatDiffusion {
 public:
  /// `t` > 0 in units of length squared. \throws UsageError on another t, and on one so long that
  /// nothing but the means is left of any heat, to the last digit; and as assemble_laplacian
  /// and make_spd_solver do. The mesh is not needed afterwards.
  HeatDiffusion(const FlatMesh& mesh, double t, const DiffusionOptions& options = {},
                const Context& context = {});

  /// One step from `u0`, V values. Several steps: call it again on the result.
  /// \throws UsageError on another length, SolverError where u0 is not finite.
  Solution step(const Eigen::VectorXd& u0, const Context& context = {}) const;

  /// t.
  double time() const { return time_; }
  const Eigen::VectorXd& mass() const { return mass_; }  ///< the diagonal of M0
  /// Faces whose normal was tilted back (embedding.h).
  Index clamped_faces() const { return clamped_faces_; }

 private:
  double time_;
  Components components_;  ///< known only where t is so long that the means are split off
  Eigen::VectorXd mass_;
  Eigen::VectorXd weight_;  ///< mass, but 1 at vertices without faces
  Index clamped_faces_ = 0;
  std::unique_ptr<SpdSolver> solver_;
};

/// The same for a single step.
Solution diffuse(const FlatMesh& mesh, const Eigen::VectorXd& u0, double t,
                 const DiffusionOptions& options = {}, const Context& context = {});

}  // namespace dsc
