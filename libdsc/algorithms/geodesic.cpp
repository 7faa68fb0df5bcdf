#include "libdsc/algorithms/geodesic.h"

#include "libdsc/algorithms/diffusion.h"
#include "libdsc/algorithms/heat_directions.h"
#include "libdsc/algorithms/heat_front.h"
#include "libdsc/algorithms/source_anchor.h"
#include "libdsc/base/error.h"
#include "libdsc/base/parallel.h"
#include "libdsc/calculus/assembly.h"
#include "libdsc/calculus/field_operators.h"
#include "libdsc/solve/boundary.h"
#include "libdsc/solve/checkerboard.h"
#include "libdsc/solve/dirichlet.h"
#include "libdsc/solve/matrix_memory.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace dsc {
namespace {

/// What the factors of both systems take, and a little more: tests/benchmarks/RESULTS.md has 2078
/// bytes a face at 100 000 faces.
constexpr Index kDirectBytesPerVertex = 2500;

constexpr double kHeatTolerance = 1e-3;  // of the componentwise residual

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Mean length of the faces' sides.
double mean_edge(const FlatMesh& mesh) {
  double sum = 0;
  for (Index f = 0; f < mesh.faces(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t i = 0; i < face.size(); ++i) {
      sum += (mesh.positions[face[i]] - mesh.positions[face[(i + 1) % face.size()]]).norm();
    }
  }
  return sum / static_cast<double>(mesh.corner_count());
}

/// An assignment would copy the matrix.
void put(LaplaceSystem from, LaplaceSystem& to) {
  to.L.swap(from.L);
  to.mass.swap(from.mass);
  to.clamped_faces = from.clamped_faces;
}

SparseMatrix negated(const SparseMatrix& L, const Context& context) {
  context.need("assemble", matrix_bytes(L));
  SparseMatrix A = L;
  parallel_for(context, A.nonZeros(), 1 << 16, [&](Index first, Index last) {
    for (double* value = A.valuePtr() + first; value != A.valuePtr() + last; ++value) {
      *value = -*value;
    }
  });
  return A;
}

/// A with the flagged unknowns held at 0: their rows and columns become those of the identity.
SparseMatrix hold(const SparseMatrix& A, std::span<const char> fixed) {
  SparseMatrix held = A;
  for (int col = 0; col < held.outerSize(); ++col) {
    const bool column = fixed[static_cast<std::size_t>(col)] != 0;
    for (SparseMatrix::InnerIterator it(held, col); it; ++it) {
      if (column || fixed[static_cast<std::size_t>(it.row())] != 0) {
        it.valueRef() = it.row() == col ? 1. : 0.;
      }
    }
  }
  held.prune([](Index, Index, double value) { return value != 0; });
  return held;
}

/// The direct diffusion for one t, without and, where wanted, with w = 0 on the boundary.
struct DirectHeat {  // empty where bands are followed
  std::unique_ptr<SpdSolver> reflected;
  std::unique_ptr<SpdSolver> absorbed;
  const SparseMatrix& A() const { return reflected->matrix(); }
};

}  // namespace

struct GeodesicSolver::Data {
  FlatMesh mesh;
  GeodesicOptions options;
  LaplaceSystem system;
  Eigen::VectorXd weight;  ///< mass, but 1 at vertices without faces
  Components components;
  std::vector<char> boundary;  ///< empty: nowhere held at 0
  double time = 0;
  double hop = 0;  ///< what a breadth-first level advances at least, roughly
  HeatMethod method = HeatMethod::direct;
  LaplaceSystem diffused;  ///< that of the heat
  SparseMatrix heat;       ///< M0 - t L, of bands; the direct solver has its own
  DirectHeat direct;
  std::unique_ptr<NeumannSolver> poisson;
  std::optional<CheckerboardFilter> filter;  ///< mercat's
  double seconds_assemble = 0;
  double seconds_factorize = 0;

  const LaplaceSystem& of_heat() const { return filter ? diffused : system; }
  const SparseMatrix& heat_operator() const { return direct.reflected ? direct.A() : heat; }

  DirectHeat factorize(double t, const Context& context) const {
    DirectHeat h;
    SparseMatrix A = heat_matrix(of_heat(), t, context);
    if (!boundary.empty()) {
      context.need("heat matrix", matrix_bytes(A));
      h.absorbed = make_solver(options.factory, hold(A, boundary), {}, context);
    }
    h.reflected = make_solver(options.factory, take(A), {}, context);
    return h;
  }

  bool held(VertexId v) const { return !boundary.empty() && boundary[static_cast<std::size_t>(v)]; }

  /// Whether w > 0 in size at every vertex that a source reaches.
  bool reaches_everywhere(const WideVector& w, const std::vector<char>& with_source) const {
    for (Index v = 0; v < w.size(); ++v) {
      const auto c = static_cast<std::size_t>(components.of_vertex[static_cast<std::size_t>(v)]);
      if (with_source[c] != 0 && w.mantissa(v) == 0) return false;
    }
    return true;
  }

  /// False where the far field is lost.
  bool solve_direct(const DirectHeat& h, std::span<const VertexId> sources,
                    const std::vector<char>& with_source, WideVector& w, double& residual,
                    const Context& context) const {
    WideVector delta(mesh.vertices());
    for (const VertexId s : sources) delta.set(s, {1, 0});
    w = h.reflected->solve_wide(delta, context);
    residual = componentwise_residual(h.A(), w, sources, {}, context);
    if (!(residual <= kHeatTolerance) || !reaches_everywhere(w, with_source)) return false;
    if (!h.absorbed) return true;
    bool any = false;
    for (const VertexId s : sources) {
      if (held(s)) {
        delta.set(s, {});
      } else {
        any = true;
      }
    }
    if (!any) return true;
    // Where absorbed heat underflows it is nothing beside the reflected.
    const WideVector absorbed = h.absorbed->solve_wide(delta, context);
    for (Index v = 0; v < w.size(); ++v) w.add(v, absorbed.mantissa(v), absorbed.exponent(v));
    return true;
  }

  void solve_bands(std::span<const VertexId> sources, WideVector& w, GeodesicReport& report,
                   const Context& context) const {
    // So many levels that heat has fallen as far at their end as it falls in 16 and 8 hops of
    // sqrt(t).
    const double stretch = std::max(1., std::sqrt(time) / hop);
    const auto levels = [&](double n) {
      return static_cast<Index>(std::min(std::ceil(n * stretch), 1e9));
    };
    FrontOptions front_options{levels(16), levels(8)};
    const SparseMatrix& A = heat_operator();
    for (const bool absorb : {false, true}) {
      if (absorb && boundary.empty()) break;
      const std::span<const char> fixed =
          absorb ? std::span<const char>(boundary) : std::span<const char>();
      for (;;) {
        HeatFront front = diffuse_front(A, sources, fixed, front_options, context);
        const double residual = componentwise_residual(A, front.w, sources, fixed, context);
        if (!(residual <= kHeatTolerance)) {
          if (front.bands <= 1) {
            throw SolverError("geodesic: heat could not be diffused; the residual is " +
                              std::to_string(residual));
          }
          front_options.band *= 2;
          front_options.overlap *= 2;
          continue;
        }
        report.bands += front.bands;
        report.heat_residual = std::max(report.heat_residual, residual);
        if (!absorb) {
          w = std::move(front.w);
        } else {
          for (Index v = 0; v < w.size(); ++v) w.add(v, front.w.mantissa(v), front.w.exponent(v));
        }
        break;
      }
    }
  }
};

GeodesicSolver::GeodesicSolver(const FlatMesh& mesh, const GeodesicOptions& options,
                               const Context& context) {
  const auto start = std::chrono::steady_clock::now();
  if (mesh.faces() == 0) throw InputError("geodesic: the surface has no face");
  if (!(options.time >= 0 && std::isfinite(options.time))) {
    throw UsageError("geodesic: the diffusion time must be positive, or 0 for the default");
  }
  auto data = std::make_unique<Data>();
  data->mesh = mesh;
  data->options = options;
  context.begin("assemble");
  put(assemble_laplacian(mesh, options.calculus, context), data->system);
  data->weight = (data->system.mass.array() > 0).select(data->system.mass, 1.);
  data->components = connected_components(mesh);
  Components classes = kernel_classes(mesh, options.calculus.stabilization);
  if (options.calculus.stabilization == Stabilization::mercat) {
    CalculusOptions stabilised = options.calculus;
    stabilised.stabilization = Stabilization::de_goes;
    put(assemble_laplacian(mesh, stabilised, context), data->diffused);
    data->filter.emplace(mesh, options.calculus, context);
  }
  if (options.boundary == HeatBoundary::mixed) {
    data->boundary = boundary_vertices(mesh);
    if (std::none_of(data->boundary.begin(), data->boundary.end(), [](char b) { return b != 0; })) {
      data->boundary.clear();
    }
  }
  const double edge = mesh.is_digital() ? mesh.spacing.maxCoeff() : mean_edge(mesh);
  data->hop = mesh.is_digital() ? mesh.spacing.minCoeff() : edge;
  data->time = options.time > 0 ? options.time : edge * edge;
  data->method = options.method;
  SolverOptions poisson = options.poisson;
  if (data->method == HeatMethod::automatic) {
    const bool fits = context.memory == nullptr ||
                      context.memory->left() > kDirectBytesPerVertex * mesh.vertices();
    if (!fits) poisson.direct_limit = std::min(poisson.direct_limit, kDirectLimitOnce);
    data->method = fits && mesh.vertices() <= kDirectLimit ? HeatMethod::direct : HeatMethod::bands;
  }
  data->seconds_assemble = seconds_since(start);

  const auto factorize = std::chrono::steady_clock::now();
  context.begin("factorize");
  if (data->method == HeatMethod::direct) {
    data->direct = data->factorize(data->time, context);
  } else {
    SparseMatrix heat = heat_matrix(data->of_heat(), data->time, context);
    data->heat.swap(heat);
  }
  // Not make_unique, which would copy the matrix.
  data->poisson.reset(new NeumannSolver(negated(data->system.L, context), std::move(classes),
                                        poisson, context, options.factory));
  data->seconds_factorize = seconds_since(factorize);
  data_ = std::move(data);
}

GeodesicSolver::~GeodesicSolver() = default;
GeodesicSolver::GeodesicSolver(GeodesicSolver&&) noexcept = default;
GeodesicSolver& GeodesicSolver::operator=(GeodesicSolver&&) noexcept = default;

double GeodesicSolver::time() const { return data_->time; }
double GeodesicSolver::seconds_assemble() const { return data_->seconds_assemble; }

GeodesicResult GeodesicSolver::distance(std::span<const VertexId> given,
                                        const Context& context) const {
  const auto start = std::chrono::steady_clock::now();
  const Data& d = *data_;
  const Index n = d.mesh.vertices();
  if (given.empty()) throw UsageError("geodesic: there is no source");
  std::vector<VertexId> sources(given.begin(), given.end());
  std::sort(sources.begin(), sources.end());
  sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
  for (const VertexId s : {sources.front(), sources.back()}) {
    if (s < 0 || s >= n) {
      throw UsageError("geodesic: there is no vertex " + std::to_string(s) + " among " +
                       std::to_string(n) + " to start from");
    }
  }
  std::vector<char> with_source(static_cast<std::size_t>(d.components.count()), 0);
  for (const VertexId s : sources) {
    with_source[static_cast<std::size_t>(d.components.of_vertex[static_cast<std::size_t>(s)])] = 1;
  }
  GeodesicResult result;
  GeodesicReport& report = result.report;
  report.time = d.time;
  report.method = d.method;
  report.components = d.components.count();
  report.components_without_source = std::count(with_source.begin(), with_source.end(), char{0});
  report.clamped_faces = d.system.clamped_faces;
  report.seconds_factorize = d.seconds_factorize;

  context.begin("heat");
  WideVector w;
  if (report.method == HeatMethod::direct) {
    bool good = d.solve_direct(d.direct, sources, with_source, w, report.heat_residual, context);
    if (!good && d.options.method == HeatMethod::automatic) report.method = HeatMethod::bands;
    while (!good && report.method == HeatMethod::direct) {
      report.time_raised = true;
      report.time *= 4;
      if (!std::isfinite(report.time))
        throw SolverError("geodesic: heat does not reach everywhere");
      good = d.solve_direct(d.factorize(report.time, context), sources, with_source, w,
                            report.heat_residual, context);
    }
  }
  if (report.method == HeatMethod::bands) d.solve_bands(sources, w, report, context);

  context.check();
  context.begin("distance");
  // Directions, their divergence, the guess, and what the solver iterates with.
  context.need("distance", 24 * d.mesh.faces() + 120 * n);
  HeatDirections directions = heat_directions(d.mesh, w, report.time, d.options.calculus, context);
  report.flat_faces = directions.flat_faces;
  report.negative_faces = directions.negative_faces;
  const Eigen::VectorXd divergence =
      integrated_divergence(d.mesh, directions.d, d.options.calculus, context);
  Eigen::VectorXd guess(n);
  for (Index v = 0; v < n; ++v) {
    Wide x = w[v];
    x.mantissa = std::abs(x.mantissa);
    guess[v] = x.mantissa == 0 ? 0. : -std::sqrt(report.time) * x.log();
  }
  Solution phi = d.poisson->solve(-divergence, {}, guess, context);
  report.poisson_residual = phi.relative_residual;
  report.poisson_iterations = phi.iterations;
  result.distance = std::move(phi.x);
  if (d.filter) d.filter->remove(result.distance, d.weight);
  anchor_sources(result.distance, d.heat_operator(), w, sources);

  for (Index v = 0; v < n; ++v) {
    double& distance = result.distance[v];
    const auto c = static_cast<std::size_t>(d.components.of_vertex[static_cast<std::size_t>(v)]);
    if (with_source[c] == 0) {
      distance = std::numeric_limits<double>::infinity();
    } else if (distance < 0) {
      ++report.raised_values;
      report.lowest_value = std::min(report.lowest_value, distance);
      distance = 0;
    } else if (!std::isfinite(distance)) {
      throw SolverError("geodesic: the distance at vertex " + std::to_string(v) +
                        " is not a number");
    }
  }
  for (const VertexId s : sources) result.distance[s] = 0;
  report.seconds_solve = seconds_since(start);
  return result;
}

GeodesicOptions for_one_query(GeodesicOptions options) {
  if (options.method == HeatMethod::automatic) options.method = HeatMethod::bands;
  options.poisson.direct_limit = std::min(options.poisson.direct_limit, kDirectLimitOnce);
  return options;
}

GeodesicResult geodesic_distance(const FlatMesh& mesh, std::span<const VertexId> sources,
                                 const GeodesicOptions& options, const Context& context) {
  return GeodesicSolver(mesh, for_one_query(options), context).distance(sources, context);
}

}  // namespace dsc
