#include "libdsc/solve/conjugate_gradient.h"

#include "libdsc/solve/multigrid_hierarchy.h"

#include <fmt/format.h>

#include <cmath>

namespace dsc {
namespace {

using Vector = Eigen::VectorXd;

/// Sum over rows of body(i), in chunk order.
template <class Body>
double sum_rows(const Context& context, Index rows, Body&& body) {
  return parallel_reduce(
      context, rows, kRowGrain, 0.0,
      [&](Index first, Index last) {
        double sum = 0;
        for (Index i = first; i < last; ++i) sum += body(i);
        return sum;
      },
      [](double s, double t) { return s + t; });
}

/// r = b - A x; returns |r|².
double residual(RowsView<double> a, const Vector& b, const Vector& x, Vector& r,
                const Context& context) {
  return sum_rows(context, a.rows, [&](Index i) {
    r[i] = b[i] - a.row_times(i, x.data());
    return r[i] * r[i];
  });
}

/// Progress in percent: the decades of the residual that are behind us.
class Progress {
 public:
  Progress(const Context& context, double tolerance)
      : context_(context), goal_(std::log(tolerance)) {
    context_.begin("solve", 100);
  }
  void residual_is(double relative) {
    const double part = relative > 0 ? std::log(relative) / goal_ : 1.0;
    const auto percent = static_cast<Index>(100.0 * std::min(1.0, std::max(0.0, part)));
    if (percent > done_) context_.advance(percent - done_);
    done_ = std::max(done_, percent);
  }

 private:
  const Context& context_;
  double goal_;
  Index done_ = 0;
};

}  // namespace

double norm(const Vector& v, const Context& context) {
  const double largest = parallel_reduce(
      context, v.size(), kRowGrain, 0.0,
      [&](Index first, Index last) {
        double most = 0;
        for (Index i = first; i < last; ++i) most = std::max(most, std::abs(v[i]));
        return most;
      },
      [](double s, double t) { return std::max(s, t); });
  if (largest == 0) return 0;
  return largest * std::sqrt(sum_rows(context, v.size(), [&](Index i) {
           const double part = v[i] / largest;
           return part * part;
         }));
}

double relative_residual(RowsView<double> a, const Vector& b, const Vector& x,
                         const Context& context) {
  Vector r(a.rows);
  residual(a, b, x, r, context);
  const double size = norm(r, context);
  return size == 0 ? 0.0 : size / norm(b, context);
}

void throw_not_converged(int iterations, double reached, double asked) {
  throw SolverError(
      fmt::format("multigrid stopped after {} iterations at a relative residual of {:.3g}, not "
                  "{:.3g}; loosen the tolerance, allow more iterations or use a direct solver",
                  iterations, reached, asked));
}

ConjugateGradientResult conjugate_gradient(RowsView<double> a, const MultigridHierarchy& multigrid,
                                           const Vector& b, Vector& x, double tolerance,
                                           int max_iterations, const Context& context) {
  const Index n = a.rows;
  ConjugateGradientResult result;
  const double size = norm(b, context);
  if (size == 0) {
    x.setZero();
    return result;
  }
  Progress progress(context, tolerance);
  MultigridHierarchy::Workspace workspace = multigrid.workspace();
  Vector r(n), z(n), p = Vector::Zero(n), q = Vector::Zero(n);

  double r_norm = std::sqrt(residual(a, b, x, r, context));
  double rz = 0;         // r·z of the last direction
  double alpha = 0;      // the last step
  bool steepest = true;  // the next direction forgets the last
  bool r_is_true = true;
  while (true) {
    context.check();
    progress.residual_is(r_norm / size);
    if (r_norm <= tolerance * size) {
      if (!r_is_true) {
        r_norm = std::sqrt(residual(a, b, x, r, context));
        r_is_true = steepest = true;
      }
      if (r_norm <= tolerance * size) break;
    }
    if (result.iterations == max_iterations) {
      throw_not_converged(result.iterations, relative_residual(a, b, x, context), tolerance);
    }
    ++result.iterations;

    multigrid.apply(r.data(), z.data(), workspace, context);
    const double rz_next = sum_rows(context, n, [&](Index i) { return r[i] * z[i]; });
    if (!(rz_next > 0))
      throw SolverError(
          "the multigrid preconditioner is not positive definite: the matrix is indefinite or not "
          "symmetric");
    // r_new - r_old = -alpha q.
    const double zq = steepest ? 0 : sum_rows(context, n, [&](Index i) { return z[i] * q[i]; });
    const double beta = steepest ? 0 : -alpha * zq / rz;
    rz = rz_next;
    steepest = false;
    parallel_for(context, n, kRowGrain, [&](Index first, Index last) {
      for (Index i = first; i < last; ++i) p[i] = z[i] + beta * p[i];
    });
    const double pq = sum_rows(context, n, [&](Index i) {
      q[i] = a.row_times(i, p.data());
      return p[i] * q[i];
    });
    if (!(pq > 0))
      throw SolverError(
          "the matrix is indefinite: conjugate gradients met a direction p with p·Ap <= 0");
    alpha = rz / pq;
    r_norm = std::sqrt(sum_rows(context, n, [&](Index i) {
      x[i] += alpha * p[i];
      r[i] -= alpha * q[i];
      return r[i] * r[i];
    }));
    r_is_true = false;
  }
  result.relative_residual = r_norm / size;
  return result;
}

}  // namespace dsc
