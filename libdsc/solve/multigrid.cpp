#include "libdsc/solve/multigrid.h"

#include "libdsc/solve/conjugate_gradient.h"
#include "libdsc/solve/matrix_components.h"
#include "libdsc/solve/matrix_memory.h"
#include "libdsc/solve/multigrid_hierarchy.h"

#include <cmath>
#include <string>

namespace dsc {
namespace {

void check_options(const MultigridOptions& o) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw UsageError(std::string("multigrid options: ") + what);
  };
  require(o.strength >= 0 && o.strength <= 1, "strength must lie in [0, 1]");
  require(o.prolongation_weight >= 0 && o.prolongation_weight < 1,
          "prolongation_weight must lie in [0, 1)");
  require(o.smoothing_degree >= 1, "smoothing_degree must be at least 1");
  require(o.smoothing_range > 1 && std::isfinite(o.smoothing_range),
          "smoothing_range must be above 1");
  require(o.coarse_size >= 1, "coarse_size must be at least 1");
  require(o.max_iterations >= 1, "max_iterations must be at least 1");
  require(o.max_incompatibility >= 0, "max_incompatibility must not be negative");
}

/// A fixed pseudo-random number in (-1, 1) per index.
double noise(std::uint32_t i) {
  i = (i ^ (i >> 16)) * 0x45d9f3bu;
  i = (i ^ (i >> 16)) * 0x45d9f3bu;
  return static_cast<double>(i ^ (i >> 16)) / 2147483648.0 - 1.0;
}

/// What one pass over the rows finds.
struct Findings {
  Index not_finite = -1;  // lowest such row, or -1
  Index negative = -1;    // lowest row with a diagonal that rules out a semi-definite matrix
  double skew = 0.0;      // v^T A u - u^T A v of two fixed vectors: 0 for a symmetric A
  double size = 0.0;      // sum of |a_ij|
};

Findings inspect_rows(RowsView<double> a, const std::vector<double>& u,
                      const std::vector<double>& v, Index first, Index last) {
  Findings f;
  for (Index i = first; i < last; ++i) {
    double au = 0, av = 0, diagonal = 0, absolute = 0;
    for (int k = a.start[i]; k < a.start[i + 1]; ++k) {
      const int j = a.column[k];
      au += a.value[k] * u[j];
      av += a.value[k] * v[j];
      absolute += std::abs(a.value[k]);
      if (j == i) diagonal = a.value[k];
    }
    if (!std::isfinite(absolute) && f.not_finite < 0) f.not_finite = i;
    if ((diagonal < 0 || (diagonal == 0 && absolute > 0)) && f.negative < 0) f.negative = i;
    f.skew += v[i] * au - u[i] * av;
    f.size += absolute;
  }
  return f;
}

Findings joined(Findings f, Findings g) {
  if (f.not_finite < 0) f.not_finite = g.not_finite;
  if (f.negative < 0) f.negative = g.negative;
  return {f.not_finite, f.negative, f.skew + g.skew, f.size + g.size};
}

/// Refuses matrices that are not finite, not symmetric or evidently indefinite.
void check_matrix(RowsView<double> a, const Context& context) {
  std::vector<double> u(a.rows), v(a.rows);
  parallel_for(context, a.rows, kRowGrain, [&](Index first, Index last) {
    for (Index i = first; i < last; ++i) {
      u[i] = noise(static_cast<std::uint32_t>(2 * i));
      v[i] = noise(static_cast<std::uint32_t>(2 * i + 1));
    }
  });
  const Findings f = parallel_reduce(
      context, a.rows, kRowGrain, Findings{},
      [&](Index first, Index last) { return inspect_rows(a, u, v, first, last); }, joined);
  if (f.not_finite >= 0) {
    throw SolverError("the matrix has an entry that is not finite in row " +
                      std::to_string(f.not_finite));
  }
  if (f.negative >= 0) {
    throw SolverError("the matrix is indefinite: row " + std::to_string(f.negative) +
                      " has a diagonal entry below zero, or zero beside couplings; pass -L or "
                      "M - tL with t > 0");
  }
  if (std::abs(f.skew) > 1e-12 * f.size) {
    throw UsageError("the matrix is not symmetric with both triangles stored");
  }
}

void check_finite(const Eigen::VectorXd& v, const char* what, const Context& context) {
  const Index place = parallel_reduce(
      context, v.size(), kRowGrain, Index{-1},
      [&](Index first, Index last) {
        for (Index i = first; i < last; ++i) {
          if (!std::isfinite(v[i])) return i;
        }
        return Index{-1};
      },
      [](Index i, Index j) { return i >= 0 ? i : j; });
  if (place >= 0) {
    throw SolverError(std::string(what) + " has a value that is not finite at " +
                      std::to_string(place));
  }
}

std::shared_ptr<const SparseMatrix> compressed(SparseMatrix&& matrix) {
  matrix.makeCompressed();
  return share(matrix);
}

}  // namespace

struct MultigridSolver::Data {
  MultigridOptions options;
  std::shared_ptr<const SparseMatrix> matrix;
  RowsView<double> rows;
  MatrixComponents components;
  std::unique_ptr<const MultigridHierarchy> hierarchy;
  MultigridReport report;
};

MultigridSolver::MultigridSolver(SparseMatrix matrix, const MultigridOptions& options,
                                 const Context& context)
    : MultigridSolver(compressed(std::move(matrix)), options, context) {}

MultigridSolver::MultigridSolver(std::shared_ptr<const SparseMatrix> matrix,
                                 const MultigridOptions& options, const Context& context) {
  check_options(options);
  if (matrix == nullptr || !matrix->isCompressed()) {
    throw UsageError("a shared matrix must be there and compressed");
  }
  if (matrix->rows() != matrix->cols()) {
    throw UsageError("the matrix must be square, not " + std::to_string(matrix->rows()) + " x " +
                     std::to_string(matrix->cols()));
  }
  context.begin("set up multigrid");
  auto data = std::make_unique<Data>();
  data->options = options;
  data->matrix = std::move(matrix);
  const SparseMatrix& a = *data->matrix;
  data->rows = {a.rows(), a.outerIndexPtr(), a.innerIndexPtr(), a.valuePtr()};
  // The rows' checks; per level the matrix in single precision and its way up and down; the product
  // of the first coarse one, in double.
  context.need("set up multigrid", 16 * a.nonZeros() + 60 * a.rows());
  check_matrix(data->rows, context);
  data->components = matrix_components(data->rows, context);
  data->hierarchy =
      std::make_unique<const MultigridHierarchy>(data->rows, data->components, options, context);
  MultigridReport& report = data->report;
  report.levels = data->hierarchy->levels();
  report.singular_components = data->components.singular_count;
  report.operator_complexity = static_cast<double>(data->hierarchy->nonzeros()) /
                               static_cast<double>(std::max<Index>(1, a.nonZeros()));
  report.bytes = data->hierarchy->bytes() + a.rows() * 8 +
                 a.nonZeros() * static_cast<Index>(sizeof(double) + sizeof(int));
  data_ = std::move(data);
}

MultigridSolver::~MultigridSolver() = default;
MultigridSolver::MultigridSolver(MultigridSolver&&) noexcept = default;
MultigridSolver& MultigridSolver::operator=(MultigridSolver&&) noexcept = default;

const MultigridReport& MultigridSolver::report() const { return data_->report; }

MultigridSolver::Solution MultigridSolver::solve(const Eigen::VectorXd& b,
                                                 const Eigen::VectorXd* start,
                                                 double relative_tolerance,
                                                 const Context& context) const {
  const Data& d = *data_;
  const Index n = d.rows.rows;
  if (b.size() != n || (start != nullptr && start->size() != n)) {
    throw UsageError("the right-hand side and the start need " + std::to_string(n) + " values");
  }
  if (!(relative_tolerance > 0 && relative_tolerance < 1)) {
    throw UsageError("the relative tolerance must lie in (0, 1)");
  }
  check_finite(b, "the right-hand side", context);
  if (start != nullptr) check_finite(*start, "the start", context);

  Solution solution;
  Eigen::VectorXd rhs = b;
  std::vector<double> shift = singular_means(d.components, b.data(), context);
  double removed = 0;
  for (std::size_t c = 0; c < shift.size(); ++c) {
    removed += shift[c] * shift[c] * static_cast<double>(d.components.size[c]);
    shift[c] = -shift[c];
  }
  if (removed > 0) {
    solution.incompatibility = std::sqrt(removed) / norm(b, context);
    if (solution.incompatibility > d.options.max_incompatibility) {
      throw SolverError(
          "the right-hand side does not sum to zero on every component on which the "
          "matrix is singular: " +
          std::to_string(solution.incompatibility) +
          " of its norm is incompatible; subtract its mean there, or fix a value");
    }
    shift_components(d.components, shift, rhs.data(), context);
  }

  solution.x = start != nullptr ? *start : Eigen::VectorXd::Zero(n);
  const std::vector<double> wanted = singular_means(d.components, solution.x.data(), context);
  const ConjugateGradientResult result = conjugate_gradient(
      d.rows, *d.hierarchy, rhs, solution.x, relative_tolerance, d.options.max_iterations, context);
  solution.iterations = result.iterations;

  // The kernel's part of x is free: give it the mean of the start.
  shift = singular_means(d.components, solution.x.data(), context);
  for (std::size_t c = 0; c < shift.size(); ++c) shift[c] = wanted[c] - shift[c];
  shift_components(d.components, shift, solution.x.data(), context);
  solution.relative_residual = relative_residual(d.rows, rhs, solution.x, context);
  if (!(solution.relative_residual <= relative_tolerance)) {
    throw_not_converged(solution.iterations, solution.relative_residual, relative_tolerance);
  }
  return solution;
}

}  // namespace dsc
