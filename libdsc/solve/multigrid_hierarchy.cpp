#include "libdsc/solve/multigrid_hierarchy.h"

#include "libdsc/solve/multigrid_aggregation.h"

#include <cmath>

namespace dsc {
namespace {

std::vector<double> diagonal_of(RowsView<double> a, const Context& context) {
  std::vector<double> diagonal(a.rows, 0.0);
  parallel_for(context, a.rows, kRowGrain, [&](Index first, Index last) {
    for (Index i = first; i < last; ++i) {
      for (int k = a.start[i]; k < a.start[i + 1]; ++k) {
        if (a.column[k] == i) diagonal[i] = a.value[k];
      }
    }
  });
  return diagonal;
}

/// A single coarse unknown of a singular component is exactly zero; rounding must not decide it.
void clear_lone_singular_rows(SparseRows<double>& a, const std::vector<int>& component,
                              const MatrixComponents& components) {
  for (Index i = 0; i < a.rows(); ++i) {
    if (!components.singular[component[i]]) continue;
    if (a.start[i + 1] - a.start[i] == 1 && a.column[a.start[i]] == i) a.value[a.start[i]] = 0.0;
  }
}

template <class T>
Index bytes_of(const std::vector<T>& v) {
  return static_cast<Index>(v.capacity() * sizeof(T));
}

}  // namespace

MultigridHierarchy::MultigridHierarchy(RowsView<double> a, const MatrixComponents& components,
                                       const MultigridOptions& options, const Context& context)
    : options_(options) {
  std::vector<double> diagonal = diagonal_of(a, context);
  const double largest = a.rows == 0 ? 0.0 : *std::max_element(diagonal.begin(), diagonal.end());
  if (largest > 0) scale_ = 1.0 / largest;

  std::vector<int> component = components.label;
  SparseRows<double> current;  // the coarse matrix in double precision, while its level is built
  RowsView<double> fine = a;
  while (true) {
    context.check();
    add_level(fine, levels_.empty(), context);
    if (fine.rows <= options_.coarse_size) {
      factorize(fine, component, components);
      direct_ = true;
      break;
    }
    const Aggregates aggregates = aggregate(fine, diagonal, options_.strength, context);
    if (aggregates.count == 0) break;  // the smoother alone converges here
    Level& level = levels_.back();
    level.prolongation = smoothed_prolongation(fine, aggregates, options_.strength,
                                               options_.prolongation_weight, context);
    level.restriction = transpose(level.prolongation);
    SparseRows<double> coarse =
        galerkin_product(fine, level.prolongation, level.restriction, context);

    std::vector<int> coarse_component(aggregates.count);
    for (Index i = 0; i < fine.rows; ++i) {
      if (aggregates.of[i] >= 0) coarse_component[aggregates.of[i]] = component[i];
    }
    component = std::move(coarse_component);
    clear_lone_singular_rows(coarse, component, components);
    current = std::move(coarse);
    fine = current.view();
    diagonal = diagonal_of(fine, context);
  }
}

void MultigridHierarchy::add_level(RowsView<double> a, bool finest, const Context& context) {
  Level& level = levels_.emplace_back();
  const Index nonzeros = a.nonzeros();
  level.value.resize(nonzeros);
  level.inverse_diagonal.resize(a.rows);
  parallel_for(context, a.rows, kRowGrain, [&](Index first, Index last) {
    for (Index i = first; i < last; ++i) {
      double sum = 0;
      for (int k = a.start[i]; k < a.start[i + 1]; ++k) {
        sum += std::abs(a.value[k]);
        level.value[k] = static_cast<float>(scale_ * a.value[k]);
      }
      // Rows too small for single precision count as empty.
      const double inverse = 1.0 / (scale_ * sum);
      level.inverse_diagonal[i] = inverse < 1e30 ? static_cast<float>(inverse) : 0.0f;
    }
  });
  if (finest) {
    level.a = {a.rows, a.start, a.column, level.value.data()};
  } else {
    level.start.assign(a.start, a.start + a.rows + 1);
    level.column.assign(a.column, a.column + nonzeros);
    level.a = {a.rows, level.start.data(), level.column.data(), level.value.data()};
  }
}

void MultigridHierarchy::factorize(RowsView<double> a, const std::vector<int>& component,
                                   const MatrixComponents& components) {
  if (a.rows == 0) return;
  SparseMatrix matrix =
      Eigen::Map<const SparseMatrix>(a.rows, a.rows, a.nonzeros(), a.start, a.column, a.value) *
      scale_;
  // Adding to one diagonal entry of a singular component leaves the solutions for compatible
  // right-hand sides, with that unknown pinned to 0.
  std::vector<std::uint8_t> pinned(components.size.size(), 0);
  for (Index i = 0; i < a.rows; ++i) {
    const int c = component[i];
    if (!components.singular[c] || pinned[c]) continue;
    pinned[c] = 1;
    double& entry = matrix.coeffRef(i, i);
    entry = entry > 0 ? 2 * entry : 1.0;
  }
  factorization_.compute(matrix);
  if (factorization_.info() != Eigen::Success || !(factorization_.vectorD().minCoeff() > 0)) {
    throw SolverError("the coarsest multigrid matrix (" + std::to_string(a.rows) +
                      " unknowns) is not positive definite, so neither is the system; use a "
                      "direct solver to find out where");
  }
}

MultigridHierarchy::Workspace MultigridHierarchy::workspace() const {
  Workspace result;
  for (const Level& level : levels_) {
    const std::vector<float> zero(level.a.rows);
    result.levels_.push_back({zero, zero, zero, zero});
  }
  result.coarse_.resize(levels_.back().a.rows);
  return result;
}

void MultigridHierarchy::apply(const double* r, double* z, Workspace& workspace,
                               const Context& context) const {
  Workspace::Vectors& v = workspace.levels_.front();
  const Index rows = levels_.front().a.rows;
  // Single precision has a short range of exponents: bring r to size 1.
  const double largest = parallel_reduce(
      context, rows, kRowGrain, 0.0,
      [&](Index first, Index last) {
        double most = 0;
        for (Index i = first; i < last; ++i) most = std::max(most, std::abs(r[i]));
        return most;
      },
      [](double s, double t) { return std::max(s, t); });
  const double down = largest > 0 ? 1.0 / largest : 0.0;
  parallel_for(context, rows, kRowGrain, [&](Index first, Index last) {
    for (Index i = first; i < last; ++i) v.rhs[i] = static_cast<float>(down * r[i]);
  });
  cycle(0, workspace, context);
  const double up = largest * scale_;
  parallel_for(context, rows, kRowGrain, [&](Index first, Index last) {
    for (Index i = first; i < last; ++i) z[i] = up * v.x[i];
  });
}

/// x <- x + q(D^-1 A) D^-1 (rhs - A x), q such that the error is damped evenly on
/// [largest / range, largest] (three-term recurrence of the Chebyshev polynomials; Y. Saad,
/// Iterative methods for sparse linear systems, 2003, section 12.3.2).
void MultigridHierarchy::smooth(const Level& level, Workspace::Vectors& v, bool from_zero,
                                const Context& context) const {
  const double upper = level.largest_eigenvalue;
  const double lower = upper / options_.smoothing_range;
  const double centre = 0.5 * (upper + lower), radius = 0.5 * (upper - lower);
  double rho = radius / centre;
  float keep = 0.0f;
  float gain = static_cast<float>(1.0 / centre);
  for (int step = 0; step < options_.smoothing_degree; ++step) {
    const bool first_guess = from_zero && step == 0;
    parallel_for(context, level.a.rows, kRowGrain, [&](Index first, Index last) {
      const float* x = v.x.data();
      for (Index i = first; i < last; ++i) {
        const float residual = first_guess ? v.rhs[i] : v.rhs[i] - level.a.row_times(i, x);
        const float change = gain * level.inverse_diagonal[i] * residual;
        const float d = step == 0 ? change : keep * v.direction[i] + change;
        v.direction[i] = d;
        v.next[i] = first_guess ? d : x[i] + d;
      }
    });
    v.x.swap(v.next);
    const double next_rho = 1.0 / (2.0 * centre / radius - rho);
    keep = static_cast<float>(next_rho * rho);
    gain = static_cast<float>(2.0 * next_rho / radius);
    rho = next_rho;
  }
}

void MultigridHierarchy::cycle(std::size_t l, Workspace& workspace, const Context& context) const {
  const Level& level = levels_[l];
  Workspace::Vectors& v = workspace.levels_[l];
  const bool last_level = l + 1 == levels_.size();
  if (last_level && direct_) {
    for (Index i = 0; i < level.a.rows; ++i) workspace.coarse_[i] = v.rhs[i];
    if (level.a.rows > 0) workspace.coarse_ = factorization_.solve(workspace.coarse_).eval();
    for (Index i = 0; i < level.a.rows; ++i) v.x[i] = static_cast<float>(workspace.coarse_[i]);
    return;
  }
  smooth(level, v, true, context);
  if (!last_level) {
    Workspace::Vectors& coarse = workspace.levels_[l + 1];
    parallel_for(context, level.a.rows, kRowGrain, [&](Index first, Index last) {
      for (Index i = first; i < last; ++i) v.next[i] = v.rhs[i] - level.a.row_times(i, v.x.data());
    });
    const RowsView<float> restriction = level.restriction.view();
    parallel_for(context, restriction.rows, kRowGrain, [&](Index first, Index last) {
      for (Index i = first; i < last; ++i) coarse.rhs[i] = restriction.row_times(i, v.next.data());
    });
    cycle(l + 1, workspace, context);
    const RowsView<float> prolongation = level.prolongation.view();
    parallel_for(context, level.a.rows, kRowGrain, [&](Index first, Index last) {
      for (Index i = first; i < last; ++i) v.x[i] += prolongation.row_times(i, coarse.x.data());
    });
  }
  smooth(level, v, false, context);
}

Index MultigridHierarchy::nonzeros() const {
  Index sum = 0;
  for (const Level& level : levels_) sum += level.a.nonzeros();
  return sum;
}

Index MultigridHierarchy::bytes() const {
  Index sum = 0;
  for (const Level& level : levels_) {
    sum += bytes_of(level.start) + bytes_of(level.column) + bytes_of(level.value) +
           bytes_of(level.inverse_diagonal) + level.prolongation.bytes() +
           level.restriction.bytes();
  }
  if (direct_ && levels_.back().a.rows > 0) {
    const auto& factor = factorization_.matrixL().nestedExpression();
    sum +=
        static_cast<Index>(factor.nonZeros()) * static_cast<Index>(sizeof(double) + sizeof(int)) +
        static_cast<Index>(factor.rows()) * static_cast<Index>(sizeof(double) + 3 * sizeof(int));
  }
  return sum;
}

}  // namespace dsc
