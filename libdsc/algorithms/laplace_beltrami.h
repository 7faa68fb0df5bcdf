/// \file
/// The Laplace-Beltrami operator applied to a function, Δf ≈ M0⁻¹ L f, and its diffused form.
///
/// On digital surfaces M0⁻¹ L f stays bounded but does not converge pointwise as h → 0: L is right
/// on average only. One implicit step of heat of a short time t over the result,
/// \f[ (M_0 - tL)^{-1} L f, \f]
/// averages over a distance of about √t; with t = 0.035 h on a shape of unit size the error is
/// about linear in h (Weill-Duflos, Coeurjolly, Lachaud 2024). Either way f must be sampled at
/// points near the smooth surface, not at raw pointels, whose offsets enter divided by h².
#pragma once

#include "libdsc/calculus/assembly.h"
#include "libdsc/solve/spd_solver.h"

#include <memory>

namespace dsc {

/// Pointwise by default.
struct LaplaceBeltramiOptions {
  CalculusOptions calculus;  ///< of L and M0
  /// t, length squared; 0: pointwise.
  double time = 0;
  SolverOptions solver{SolverMethod::automatic, 1e-9};  ///< of the diffusion
  SpdSolverFactory factory;                             ///< empty: make_spd_solver
};

/// Assembled, and factorized where there is a time, once for a surface.
class LaplaceBeltrami {
 public:
  /// \throws UsageError where the time is negative or not finite, and as assemble_laplacian() and
  /// make_spd_solver() do. The mesh is not needed afterwards.
  explicit LaplaceBeltrami(const FlatMesh& mesh, const LaplaceBeltramiOptions& options = {},
                           const Context& context = {});

  /// M0⁻¹ L f, of the unit of f over length squared; 0 at vertices without faces. `f` has V values.
  /// \throws UsageError on another length, InputError where f is not finite.
  Eigen::VectorXd pointwise(const Eigen::VectorXd& f) const;
  /// (M0 − t L)⁻¹ M0 g, for values g that are there already; g itself where t = 0.
  Solution smoothed(const Eigen::VectorXd& g, const Context& context = {}) const;
  /// The two in turn: Δf.
  Solution operator()(const Eigen::VectorXd& f, const Context& context = {}) const {
    return smoothed(pointwise(f), context);
  }

  /// L and M0.
  const LaplaceSystem& system() const { return system_; }
  /// Wall time of the factorization; 0 where t = 0.
  double seconds_factorize() const { return seconds_factorize_; }

 private:
  LaplaceSystem system_;
  Eigen::VectorXd weight_;             ///< mass, but 1 at vertices without faces
  std::unique_ptr<SpdSolver> solver_;  ///< null where t = 0
  double seconds_factorize_ = 0;
};

}  // namespace dsc
