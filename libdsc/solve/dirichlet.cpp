#include "libdsc/solve/dirichlet.h"

#include "libdsc/base/error.h"
#include "libdsc/solve/matrix_memory.h"

#include <cmath>
#include <string>
#include <utility>

namespace dsc {
namespace {

constexpr double kCompatible = 1e-9;

void check_length(const Eigen::VectorXd& v, Index n, const char* what) {
  if (v.size() != n) {
    throw UsageError(std::string(what) + " has " + std::to_string(v.size()) +
                     " entries instead of " + std::to_string(n));
  }
}

/// Whether A couples vertices of different components.
bool crosses(const SparseMatrix& A, const Components& components) {
  for (int col = 0; col < A.outerSize(); ++col) {
    const VertexId c = components.of_vertex[static_cast<std::size_t>(col)];
    for (SparseMatrix::InnerIterator it(A, col); it; ++it) {
      if (it.value() != 0 && components.of_vertex[static_cast<std::size_t>(it.row())] != c) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

DirichletSolver::DirichletSolver(const SparseMatrix& A, std::span<const VertexId> fixed,
                                 const SolverOptions& options, const Context& context,
                                 const SpdSolverFactory& factory)
    : n_(A.rows()) {
  if (A.rows() != A.cols()) throw UsageError("Dirichlet: the matrix is not square");
  std::vector<VertexId> number(static_cast<std::size_t>(n_), 0);
  for (const VertexId v : fixed) {
    if (v < 0 || v >= n_) {
      throw UsageError("Dirichlet: there is no vertex " + std::to_string(v) + " to fix among " +
                       std::to_string(n_));
    }
    number[static_cast<std::size_t>(v)] = -1;
  }
  for (Index v = 0; v < n_; ++v) {
    VertexId& id = number[static_cast<std::size_t>(v)];
    if (id < 0) continue;
    id = static_cast<VertexId>(free_.size());
    free_.push_back(static_cast<VertexId>(v));
  }
  if (free_.empty()) return;

  // The matrix of the free ones and their couplings, each with room while it grows.
  context.need("fix values", 2 * matrix_bytes(A));
  // Row numbers keep their order, so columns come out sorted.
  const auto m = static_cast<Eigen::Index>(free_.size());
  SparseMatrix reduced(m, m);
  coupling_.resize(m, n_);
  std::vector<int> in_reduced(static_cast<std::size_t>(m), 0);
  std::vector<int> in_coupling(static_cast<std::size_t>(n_), 0);
  for (int col = 0; col < A.outerSize(); ++col) {
    const VertexId j = number[static_cast<std::size_t>(col)];
    int rows = 0;
    for (SparseMatrix::InnerIterator it(A, col); it; ++it) {
      if (number[static_cast<std::size_t>(it.row())] >= 0) ++rows;
    }
    (j >= 0 ? in_reduced[static_cast<std::size_t>(j)]
            : in_coupling[static_cast<std::size_t>(col)]) = rows;
  }
  reduced.reserve(in_reduced);
  coupling_.reserve(in_coupling);
  for (int col = 0; col < A.outerSize(); ++col) {
    const VertexId j = number[static_cast<std::size_t>(col)];
    for (SparseMatrix::InnerIterator it(A, col); it; ++it) {
      const VertexId i = number[static_cast<std::size_t>(it.row())];
      if (i < 0) continue;
      (j >= 0 ? reduced.insert(i, j) : coupling_.insert(i, col)) = it.value();
    }
  }
  reduced.makeCompressed();
  coupling_.makeCompressed();
  solver_ = make_solver(factory, take(reduced), options, context);
}

Solution DirichletSolver::solve(const Eigen::VectorXd& b, const Eigen::VectorXd& values,
                                const Context& context) const {
  check_length(b, n_, "Dirichlet: the right-hand side");
  check_length(values, n_, "Dirichlet: the values");
  if (!values.allFinite()) throw SolverError("Dirichlet: a value is not finite");
  Solution result;
  result.x = values;
  if (free_.empty()) return result;
  Eigen::VectorXd rhs(free_unknowns());
  Eigen::VectorXd guess(free_unknowns());
  for (Index i = 0; i < free_unknowns(); ++i) {
    rhs[i] = b[free_[static_cast<std::size_t>(i)]];
    guess[i] = values[free_[static_cast<std::size_t>(i)]];
  }
  rhs.noalias() -= coupling_ * values;
  Solution inner = solver_->solve(rhs, guess, context);
  for (Index i = 0; i < free_unknowns(); ++i) {
    result.x[free_[static_cast<std::size_t>(i)]] = inner.x[i];
  }
  result.relative_residual = inner.relative_residual;
  result.iterations = inner.iterations;
  return result;
}

NeumannSolver::NeumannSolver(SparseMatrix A, Components components, const SolverOptions& options,
                             const Context& context, const SpdSolverFactory& factory)
    : components_(std::move(components)), tolerance_(options.tolerance) {
  if (static_cast<Index>(components_.of_vertex.size()) != A.rows()) {
    throw UsageError("Neumann: the components are those of another mesh");
  }
  // Where couplings cross the components (the classes of checkerboard.h), multigrid's coarse
  // functions do not span the kernel.
  const bool crossed = crosses(A, components_);
  SolverOptions used = options;
  if (crossed) used.method = SolverMethod::ldlt;
  if (factory || resolve(used, A.rows()) == SolverMethod::ldlt) {
    direct_.emplace(A, components_.lowest, used, context, factory);
  } else {  // it needs no fixed vertex, and converges faster without
    A.makeCompressed();
    multigrid_.emplace(share(A), MultigridOptions{}, context);
  }
}

Solution NeumannSolver::solve(const Eigen::VectorXd& b, const Eigen::VectorXd& weights,
                              const Eigen::VectorXd& guess, const Context& context) const {
  const auto n = static_cast<Index>(components_.of_vertex.size());
  check_length(b, n, "Neumann: the right-hand side");
  if (weights.size() != 0) check_length(weights, n, "Neumann: the weights");
  if (!b.allFinite()) throw SolverError("Neumann: the right-hand side is not finite");
  const Index count = components_.count();
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(count);
  Eigen::VectorXd size = Eigen::VectorXd::Zero(count);
  for (Index v = 0; v < n; ++v) {
    sum[components_.of_vertex[static_cast<std::size_t>(v)]] += b[v];
    size[components_.of_vertex[static_cast<std::size_t>(v)]] += std::abs(b[v]);
  }
  for (Index c = 0; c < count; ++c) {
    if (!(std::abs(sum[c]) <= kCompatible * size[c])) {
      throw InputError("Neumann: the right-hand side sums to " + std::to_string(sum[c]) +
                       " on the component (with Stabilization::mercat, the parity) of vertex " +
                       std::to_string(components_.lowest[static_cast<std::size_t>(c)]) +
                       ", so no solution exists; subtract its mean there, or fix a vertex");
    }
  }
  Eigen::VectorXd start = Eigen::VectorXd::Zero(n);
  if (guess.size() != 0) {
    check_length(guess, n, "Neumann: the first guess");
    for (Index v = 0; v < n; ++v) {
      const VertexId c = components_.of_vertex[static_cast<std::size_t>(v)];
      start[v] = guess[v] - guess[components_.lowest[static_cast<std::size_t>(c)]];
    }
  }
  Solution result;
  if (direct_) {
    result = direct_->solve(b, start, context);
  } else {
    MultigridSolver::Solution s = multigrid_->solve(b, &start, tolerance_, context);
    result = {std::move(s.x), s.relative_residual, s.iterations};
  }
  const Eigen::VectorXd mean = component_means(components_, weights, result.x);
  for (Index v = 0; v < n; ++v) {
    result.x[v] -= mean[components_.of_vertex[static_cast<std::size_t>(v)]];
  }
  return result;
}

}  // namespace dsc
