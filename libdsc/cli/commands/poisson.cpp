#include "libdsc/algorithms/poisson.h"

#include "libdsc/base/error.h"
#include "libdsc/cli/commands/commands.h"
#include "libdsc/cli/smooth_surface.h"
#include "libdsc/solve/boundary.h"
#include "libdsc/solve/checkerboard.h"

#include <cmath>

namespace dsc::cli {
namespace {

/// Which vertices have given values, and which components (with mercat, parities) nothing but a
/// free constant.
struct Conditions {
  std::vector<VertexId> fixed;  ///< on the boundary; and the lowest vertex of each free component
  Components components;
  std::vector<char> free;  ///< a component
  Index free_count = 0;
};

Conditions conditions_of(const FlatMesh& mesh, bool fix, Stabilization stabilisation) {
  Conditions c;
  c.components = kernel_classes(mesh, stabilisation);
  c.free.assign(static_cast<std::size_t>(c.components.count()), 1);
  if (fix) {
    const std::vector<char> boundary = boundary_vertices(mesh);
    for (std::size_t v = 0; v < boundary.size(); ++v) {
      if (boundary[v] == 0) continue;
      c.fixed.push_back(static_cast<VertexId>(v));
      c.free[static_cast<std::size_t>(c.components.of_vertex[v])] = 0;
    }
    if (c.fixed.empty()) {
      throw UsageError(
          "--fix gives values on the boundary, but the surface has none; leave it out");
    }
  }
  for (std::size_t k = 0; k < c.free.size(); ++k) {
    if (c.free[k] == 0) continue;
    ++c.free_count;
    if (fix) c.fixed.push_back(c.components.lowest[k]);
  }
  return c;
}

/// Takes from `density` its mean, weighted by `mass`, on every free component; where only rounding
/// is left of it, nothing is. Returns the largest mean, in size.
double remove_means(Eigen::VectorXd& density, const Eigen::VectorXd& mass, const Conditions& c) {
  const auto component = [&](Index v) {
    return c.components.of_vertex[static_cast<std::size_t>(v)];
  };
  const Eigen::VectorXd weight = (mass.array() > 0).select(mass, 1.);  // 1 at isolated vertices
  Eigen::VectorXd means = component_means(c.components, weight, density);
  for (Index k = 0; k < means.size(); ++k) {
    if (c.free[static_cast<std::size_t>(k)] == 0) means[k] = 0;
  }
  Eigen::VectorXd left = Eigen::VectorXd::Zero(means.size());
  for (Index v = 0; v < density.size(); ++v) {
    density[v] -= means[component(v)];
    left[component(v)] = std::max(left[component(v)], std::abs(density[v]));
  }
  for (Index v = 0; v < density.size(); ++v) {
    if (left[component(v)] < 1e-12 * std::abs(means[component(v)])) density[v] = 0;
  }
  return means.cwiseAbs().maxCoeff();
}

struct PoissonAnswer {
  Eigen::VectorXd u;
  PoissonReport report;
  Index clamped_faces = 0;
};

/// `density` is the right-hand side, `values` hold on the boundary where `fix` is set.
PoissonAnswer solve(const FlatMesh& mesh, const Conditions& conditions, Eigen::VectorXd density,
                    const Eigen::VectorXd& values, bool fix, Run& run) {
  Timings& timings = run.report.timings;
  PoissonOptions options;
  options.calculus = calculus_options(run);
  options.solver.method = SolverMethod::automatic;
  options.solver.direct_limit = kDirectLimitOnce;
  options.factory = timed_solvers(run);
  std::optional<PoissonProblem> problem;
  {
    const Stopwatch watch(timings.assemble);
    problem.emplace(mesh, conditions.fixed, options, run.context);
  }
  timings.assemble -= timings.factorize;

  PoissonAnswer answer;
  answer.clamped_faces = problem->clamped_faces();
  PoissonReport& report = answer.report;
  report.fixed_vertices = static_cast<Index>(conditions.fixed.size());
  report.free_components = conditions.free_count;
  if (fix) report.fixed_vertices -= conditions.free_count;
  report.removed_mean = remove_means(density, problem->mass(), conditions);
  Solution solution;
  {
    const Stopwatch watch(timings.solve);
    solution = problem->solve(problem->mass().cwiseProduct(density), values, run.context);
  }
  if (fix) remove_means(solution.x, problem->mass(), conditions);
  report.relative_residual = solution.relative_residual;
  answer.u = std::move(solution.x);
  return answer;
}

/// Where the vertices digitise a shape, its points closest to them; else the vertices.
Eigen::Matrix3Xd sample_points(const Scene& scene, Run& run) {
  if (scene.input.shape) return smooth_surface(scene, run).positions;
  return scene.positions().matrix();
}

}  // namespace

void run_poisson(Run& run) {
  const Expression rhs(run.options.rhs);
  std::optional<Expression> fix;
  if (!run.options.fix.empty()) fix.emplace(run.options.fix);
  const Scene scene = prepare_scene(run);
  const FlatMesh mesh = flat_mesh(scene, run);
  const std::optional<FlatMesh> naive_mesh = mesh_to_compare(mesh, run);
  const Eigen::Matrix3Xd positions = sample_points(scene, run);
  const Vec3View points{positions.data(), positions.cols()};
  Timings& timings = run.report.timings;
  Conditions conditions;
  Eigen::VectorXd density, values = Eigen::VectorXd::Zero(mesh.vertices());
  {
    const Stopwatch watch(timings.assemble);
    conditions = conditions_of(mesh, fix.has_value(), run.options.stabilisation);
    density = sample(rhs, points, scene, run);
    if (fix) values = sample(*fix, points, scene, run);
  }
  const PoissonAnswer answer = solve(mesh, conditions, density, values, fix.has_value(), run);
  note_calculus(answer.clamped_faces, run);
  run.report.poisson = answer.report;
  Eigen::VectorXd naive;
  if (naive_mesh) {
    naive = compared(run, [&] {
      return solve(*naive_mesh, conditions, density, values, fix.has_value(), run).u;
    });
  }
  run.report.result_name = "solution";
  run.report.result = statistics_of(answer.u);
  Result fields{scene.mesh(), {scalar_field("solution", FieldOn::vertex, answer.u)}};
  if (naive_mesh) fields.fields.push_back(scalar_field("solution_naive", FieldOn::vertex, naive));
  write_outputs(scene, fields, run);
}

}  // namespace dsc::cli
