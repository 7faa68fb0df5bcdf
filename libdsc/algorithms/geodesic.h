/// \file
/// Geodesic distance from one or many vertices by the heat method (Crane, Weischedel, Wardetzky
/// 2013), on the corrected calculus.
///
/// \f[ (M_0 - tL)\,w = \delta_S, \qquad d = -\frac{Gw}{|Gw|}, \qquad
///      L\varphi = \sum_f \mathrm{Div}_f V_f d_f, \f]
/// S the sources, d a vector a face; φ, shifted so that the sources are at 0, is the distance.
/// Guaranteed: exactly 0 at every source, never negative, never NaN; +infinity on components
/// (through shared vertices) that hold no source; right at any distance, since heat is kept in
/// numbers that do not underflow; the same bits for any thread count.
///
/// Two ways to diffuse the heat. `direct` factorizes M0 - t L once and then serves any sources;
/// `bands` follows the front of each set of sources (heat_front.h), in linear time and little
/// memory. Both give the same distances to about 1e-3 of the gridstep.
///
/// With Stabilization::mercat Poisson's equation alone is solved with λ_f = 0, and its solution
/// comes without checkerboards. Heat is diffused with CalculusOptions::lambda: half of a point
/// source is a checkerboard, which λ_f = 0 would leave where it is.
#pragma once

#include "libdsc/calculus/options.h"
#include "libdsc/solve/spd_solver.h"
#include "libdsc/surface/flat_mesh.h"

#include <memory>
#include <span>

namespace dsc {

/// How the heat is diffused; see above.
enum class HeatMethod {
  automatic,  ///< direct where many sources are to be served on a small surface, else bands
  direct,     ///< factorizes M0 - t L once for all sources
  bands,      ///< small systems along the front, for each set of sources anew
};

/// What heat does at the boundary of the surface; the same thing where there is none.
enum class HeatBoundary {
  neumann,  ///< is reflected: distances bend to meet the boundary at right angles
  mixed,    ///< the mean of reflected and absorbed, which cancels most of that bend; the default
};

/// The defaults suit digital surfaces and meshes alike.
struct GeodesicOptions {
  CalculusOptions calculus;  ///< of L, M0 and G
  /// Diffusion time t in length squared; 0: the square of the largest spacing of a digital surface,
  /// of the mean edge length of another.
  double time = 0;
  HeatBoundary boundary = HeatBoundary::mixed;  ///< see HeatBoundary
  HeatMethod method = HeatMethod::automatic;    ///< see HeatMethod
  /// The solver of Poisson's equation; its tolerance is that of the distance's gradient.
  SolverOptions poisson{SolverMethod::automatic, 1e-5};
  /// Makes the solvers; empty: make_spd_solver.
  SpdSolverFactory factory;
};

/// How the distances came about.
struct GeodesicReport {
  double time = 0;                         ///< t used
  bool time_raised = false;                ///< t was raised, since heat did not reach every vertex
  HeatMethod method = HeatMethod::direct;  ///< direct or bands
  Index bands = 0;                         ///< solved, over all diffusions; 0 for direct
  Index components = 0;                    ///< of the surface, through shared vertices
  Index components_without_source = 0;     ///< where the distance is +infinity
  Index clamped_faces = 0;                 ///< of the calculus
  Index flat_faces = 0;          ///< without a direction: heat is nearly the same at all corners
  Index negative_faces = 0;      ///< with heat below zero at a corner, of which the size counts
  Index raised_values = 0;       ///< vertices set to 0 because they came out below
  double lowest_value = 0;       ///< the lowest of these, in length; else 0
  double heat_residual = 0;      ///< componentwise_residual of heat_front.h
  double poisson_residual = 0;   ///< ||b - A x|| / ||b||
  Index poisson_iterations = 0;  ///< 0 where solved directly
  double seconds_factorize = 0;  ///< direct factorizations, in the constructor
  double seconds_solve = 0;      ///< everything that depends on the sources
};

/// Distances and how they came about.
struct GeodesicResult {
  Eigen::VectorXd distance;  ///< V, in the unit of the positions
  GeodesicReport report;     ///< of this query
};

/// Built once for a surface, then asked for distances from any sources; queries are const and may
/// run side by side.
class GeodesicSolver {
 public:
  /// What `mesh` looks at must outlive this. `automatic` means direct up to 150 000 vertices
  /// where context.memory leaves room for the factors.
  /// \throws InputError where the mesh has no face, UsageError on options out of range, and as
  /// assemble_laplacian and make_spd_solver do.
  explicit GeodesicSolver(const FlatMesh& mesh, const GeodesicOptions& options = {},
                          const Context& context = {});
  ~GeodesicSolver();
  GeodesicSolver(GeodesicSolver&&) noexcept;
  GeodesicSolver& operator=(GeodesicSolver&&) noexcept;

  /// Distances from the nearest of `sources`: at least one vertex id, duplicates allowed.
  /// \throws UsageError where there is none or one is out of range; SolverError.
  GeodesicResult distance(std::span<const VertexId> sources, const Context& context = {}) const;

  /// t, unless a query has to raise it (GeodesicReport::time).
  double time() const;
  /// Wall time that the constructor took to assemble L and M0.
  double seconds_assemble() const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

/// The options for a solver that is asked once: what `automatic` chooses for many queries does not
/// pay then. Heat goes in bands, and Poisson's equation is iterated from kDirectLimitOnce on.
GeodesicOptions for_one_query(GeodesicOptions options);

/// The same for a single set of sources, with for_one_query(options).
GeodesicResult geodesic_distance(const FlatMesh& mesh, std::span<const VertexId> sources,
                                 const GeodesicOptions& options = {}, const Context& context = {});

}  // namespace dsc
