#include "libdsc/solve/matrix_free.h"

#include "libdsc/base/error.h"
#include "libdsc/base/parallel.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace dsc {
namespace {

using Vector = Eigen::VectorXd;
constexpr Index kGrain = 1 << 14;

/// Sum over the entries of body(i), in chunk order.
template <class Body>
double sum(const Context& context, Index n, Body&& body) {
  return parallel_reduce(
      context, n, kGrain, 0.,
      [&](Index first, Index last) {
        double part = 0;
        for (Index i = first; i < last; ++i) part += body(i);
        return part;
      },
      [](double a, double b) { return a + b; });
}

MatrixFreeSolution iterate(const LinearMap& apply, const LinearMap& precondition, const Vector& b,
                           Vector x, const MatrixFreeOptions& options, const Context& context) {
  const Index n = b.size();
  Vector r(n), z(n), q(n), p = Vector::Zero(n);
  const auto true_residual = [&] {
    apply(x, q);
    return std::sqrt(sum(context, n, [&](Index i) {
      r[i] = b[i] - q[i];
      return r[i] * r[i];
    }));
  };

  MatrixFreeSolution result;
  double norm = true_residual();
  bool is_true = true;  // the recurrence drifts from b - A x
  double rz = 0;        // of the last direction; 0: the next one forgets it
  while (true) {
    context.check();
    if (norm <= options.residual && !is_true) {
      norm = true_residual();
      is_true = true;
      rz = 0;
    }
    if (norm <= options.residual) break;
    if (result.iterations == options.max_iterations) {
      throw SolverError(fmt::format(
          "conjugate gradients stopped after {} iterations at a residual of {:.3g}, not {:.3g}",
          result.iterations, true_residual(), options.residual));
    }
    ++result.iterations;
    precondition(r, z);
    const double rz_next = sum(context, n, [&](Index i) { return r[i] * z[i]; });
    if (!(rz_next > 0)) throw SolverError("the preconditioner is not positive definite");
    const double beta = rz == 0 ? 0. : rz_next / rz;
    rz = rz_next;
    parallel_for(context, n, kGrain, [&](Index first, Index last) {
      for (Index i = first; i < last; ++i) p[i] = z[i] + beta * p[i];
    });
    apply(p, q);
    const double pq = sum(context, n, [&](Index i) { return p[i] * q[i]; });
    if (!(pq > 0)) throw SolverError("the matrix is not positive definite");
    const double step = rz / pq;
    norm = std::sqrt(sum(context, n, [&](Index i) {
      x[i] += step * p[i];
      r[i] -= step * q[i];
      return r[i] * r[i];
    }));
    is_true = false;
    if (!std::isfinite(norm)) {
      throw SolverError(
          "conjugate gradients left the range of doubles: the matrix is not positive "
          "definite or badly scaled");
    }
  }
  result.x = std::move(x);
  result.residual = norm;
  return result;
}

/// Exponents of b from here on have squares that leave the range of doubles.
constexpr int kExtreme = 300;

}  // namespace

MatrixFreeSolution solve_matrix_free(const LinearMap& apply, const LinearMap& precondition,
                                     const Vector& b, Vector x, const MatrixFreeOptions& options,
                                     const Context& context) {
  if (!(options.residual > 0)) throw UsageError("matrix-free solve: the residual must be positive");
  if (x.size() != b.size()) throw UsageError("matrix-free solve: the guess has another length");
  if (!b.allFinite() || !x.allFinite()) {
    throw SolverError("matrix-free solve: the right-hand side or the first guess is not finite");
  }
  const double largest = b.size() == 0 ? 0. : b.cwiseAbs().maxCoeff();
  const int exponent = largest == 0 ? 0 : std::ilogb(largest);
  if (std::abs(exponent) < kExtreme) {
    return iterate(apply, precondition, b, std::move(x), options, context);
  }
  // In a unit, a power of two, in which b is of size 1.
  const auto times = [](const Vector& v, int power) -> Vector {
    return v.unaryExpr([power](double value) { return std::ldexp(value, power); });
  };
  const MatrixFreeOptions scaled{std::ldexp(options.residual, -exponent), options.max_iterations};
  MatrixFreeSolution result =
      iterate(apply, precondition, times(b, -exponent), times(x, -exponent), scaled, context);
  result.x = times(result.x, exponent);
  result.residual = std::ldexp(result.residual, exponent);
  if (!result.x.allFinite()) throw SolverError("matrix-free solve: the solution is beyond doubles");
  return result;
}

}  // namespace dsc
