#include "libdsc/solve/spectrum.h"

#include "libdsc/base/error.h"
#include "libdsc/solve/inertia.h"
#include "libdsc/solve/ldlt_factor.h"
#include "libdsc/solve/matrix_memory.h"

#include <Spectra/SymEigsSolver.h>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace dsc {
namespace {

constexpr Index kDense = 150;  // below, all eigenvalues at once cost less
constexpr Index kGuard = 8;    // computed beyond those wanted, to see the gap after them
constexpr double kGap = 1e-6;  // relative: closer eigenvalues are copies of each other
constexpr Index kRounds = 12;  // far more than any multiplicity needs
constexpr Index kLanczosRestarts = 500;

void check_input(const SparseMatrix& A, const Eigen::VectorXd& mass, const SpectrumOptions& o) {
  const Index n = A.rows();
  if (A.cols() != n || mass.size() != n) {
    throw UsageError("spectrum: the matrix is " + std::to_string(n) + " x " +
                     std::to_string(A.cols()) + ", the mass has " + std::to_string(mass.size()) +
                     " entries; all must be the same");
  }
  if (o.count < 1 || o.count > n) {
    throw UsageError("spectrum: " + std::to_string(o.count) + " eigenvalues of a surface of " +
                     std::to_string(n) + " vertices; ask for 1 to " + std::to_string(n));
  }
  if (!(o.tolerance > 0 && o.tolerance < 1)) {
    throw UsageError("spectrum: the tolerance must lie in (0, 1)");
  }
  for (Index v = 0; v < n; ++v) {
    if (!(mass[v] > 0) || !std::isfinite(mass[v])) {
      throw InputError("spectrum: vertex " + std::to_string(v) + " has the mass " +
                       std::to_string(mass[v]) + "; remove vertices that no face uses");
    }
  }
}

/// Eigenpairs of S = M^(-1/2) A M^(-1/2), orthonormal.
struct Pairs {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

SparseMatrix shifted(const SparseMatrix& A, const Eigen::VectorXd& mass, double shift) {
  SparseMatrix M(A.rows(), A.cols());  // also where A stores no diagonal
  M.setIdentity();
  M.diagonal() = shift * mass;
  return A - M;
}

/// y = (S - σ)⁻¹ x without the part in the span of `found`.
class InverseOp {
 public:
  using Scalar = double;

  InverseOp(const LdltFactor& factor, const Eigen::VectorXd& root, const Eigen::MatrixXd& found,
            const Context& context)
      : factor_(factor), root_(root), found_(found), context_(context) {}
  Index rows() const { return root_.size(); }
  Index cols() const { return root_.size(); }

  void perform_op(const double* in, double* out) const {
    context_.check();
    Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(in, rows());
    remove_found(x);
    x = root_.cwiseProduct(factor_.solve(root_.cwiseProduct(x)));
    remove_found(x);
    Eigen::Map<Eigen::VectorXd>(out, rows()) = x;
    context_.advance(1);
  }

 private:
  void remove_found(Eigen::VectorXd& x) const {
    if (found_.cols() > 0) x -= found_ * (found_.transpose() * x);
  }

  const LdltFactor& factor_;
  const Eigen::VectorXd& root_;  ///< of the mass
  const Eigen::MatrixXd& found_;
  const Context& context_;
};

class LowestPairs {
 public:
  LowestPairs(const SparseMatrix& A, const Eigen::VectorXd& mass, const Context& context)
      : A_(A), mass_(mass), root_(mass.cwiseSqrt()), context_(context) {
    // The constants of a connected surface have μ = 0, the next eigenvalue is of the order of
    // 1 / area.
    shift_ = -1. / mass.sum();
    factor_.emplace(shifted(A, mass, shift_), FillOrder::nested_dissection, context);
    found_.vectors.resize(A.rows(), 0);
  }

  double shift() const { return shift_; }
  const Pairs& found() const { return found_; }

  /// Finds `count` more.
  void extend(Index count) {
    const Index n = A_.rows();
    const Index wanted = std::min(count, n - found_.vectors.cols() - 1);
    if (wanted < 1) return;
    const Index steps = std::min(n - found_.vectors.cols(), std::max<Index>(2 * wanted + 1, 24));
    // Lanczos' vectors, and then those found with the new ones: as a basis, under A, as results.
    context_.need("spectrum", 8 * n * (steps + 5 * (found_.vectors.cols() + wanted)));
    const InverseOp op(*factor_, root_, found_.vectors, context_);
    Spectra::SymEigsSolver<InverseOp> lanczos(const_cast<InverseOp&>(op), wanted, steps);
    Index got = 0;
    try {
      lanczos.init();
      got = lanczos.compute(Spectra::SortRule::LargestAlge, kLanczosRestarts, 1e-11);
    } catch (const Error&) {
      throw;
    } catch (const std::exception& failure) {  // Spectra's own
      throw SolverError(std::string("spectrum: Lanczos broke down: ") + failure.what());
    }
    if (got == 0) {
      throw SolverError("spectrum: Lanczos found no eigenvalue of " + std::to_string(n) +
                        " unknowns");
    }
    append(lanczos.eigenvectors(got));
  }

  /// Finds all, by dense algebra.
  void solve_dense() {
    context_.need("spectrum", 8 * 8 * A_.rows() * A_.rows());
    append(Eigen::MatrixXd::Identity(A_.rows(), A_.rows()));
  }

  /// The number of eigenvalues below τ, or nothing where that cannot be told.
  std::optional<Index> count_below(double tau) const {
    return negative_eigenvalues(shifted(A_, mass_, tau), context_);
  }

  Eigen::MatrixXd apply(const Eigen::MatrixXd& y) const {
    const Eigen::VectorXd inverse_root = root_.cwiseInverse();
    return inverse_root.asDiagonal() * (A_ * (inverse_root.asDiagonal() * y)).eval();
  }

  const Eigen::VectorXd& root() const { return root_; }

 private:
  /// Adds new directions, and takes the best approximations from all (Rayleigh and Ritz).
  void append(const Eigen::MatrixXd& fresh) {
    Eigen::MatrixXd basis(A_.rows(), found_.vectors.cols() + fresh.cols());
    basis << found_.vectors, fresh;
    for (Index j = found_.vectors.cols(); j < basis.cols(); ++j) {
      for (int twice = 0; twice < 2; ++twice) {
        const auto before = basis.leftCols(j);
        basis.col(j) -= before * (before.transpose() * basis.col(j)).eval();
      }
      basis.col(j).normalize();
    }
    Eigen::MatrixXd ritz = basis.transpose() * apply(basis);
    ritz = 0.5 * (ritz + ritz.transpose().eval());
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> small(ritz);
    found_.values = small.eigenvalues();
    found_.vectors = basis * small.eigenvectors();
  }

  const SparseMatrix& A_;
  const Eigen::VectorXd& mass_;
  Eigen::VectorXd root_;
  const Context& context_;
  double shift_;
  std::optional<LdltFactor> factor_;
  Pairs found_;
};

/// Whether `next` is an eigenvalue of its own and no copy of `last`, up to rounding.
bool is_gap(double last, double next, double shift) { return next - last > kGap * (last - shift); }

/// The number j >= wanted of values before the first gap, or 0 where none is in sight.
Index first_gap(const Eigen::VectorXd& values, Index wanted, double shift) {
  for (Index j = wanted; j < values.size(); ++j) {
    if (is_gap(values[j - 1], values[j], shift)) return j;
  }
  return 0;
}

/// How many of the values up to the gap after j are missing.
Index missing_below_gap(const LowestPairs& pairs, Index j) {
  const Eigen::VectorXd& values = pairs.found().values;
  for (const double place : {0.5, 0.3, 0.7, 0.15, 0.85}) {
    const double tau = values[j - 1] + place * (values[j] - values[j - 1]);
    const std::optional<Index> count = pairs.count_below(tau);
    if (!count) continue;
    if (*count < j) break;  // more were found than there are
    return *count - j;
  }
  throw SolverError("spectrum: the eigenvalues below " + std::to_string(values[j]) +
                    " cannot be counted reliably; ask for a few more or fewer");
}

/// Makes the entry largest in size of each column positive.
void fix_signs(Eigen::MatrixXd& vectors) {
  for (Index j = 0; j < vectors.cols(); ++j) {
    Index largest = 0;
    vectors.col(j).cwiseAbs().maxCoeff(&largest);
    if (vectors(largest, j) < 0) vectors.col(j) *= -1.;
  }
}

Spectrum finish(const LowestPairs& pairs, Index count, double tolerance, const Context& context) {
  Spectrum result;
  context.need("spectrum",
               4 * 8 * count * pairs.found().vectors.rows());  // as they are and under S
  result.values = pairs.found().values.head(count);
  const Eigen::MatrixXd y = pairs.found().vectors.leftCols(count);
  const Eigen::MatrixXd r = pairs.apply(y) - y * result.values.asDiagonal();
  for (Index j = 0; j < count; ++j) {
    const double residual = r.col(j).norm() / (result.values[j] - pairs.shift());
    if (!(residual <= tolerance)) {
      throw SolverError("spectrum: eigenvalue " + std::to_string(j) +
                        " has a relative residual of " + std::to_string(residual) +
                        "; its neighbours are too close for Lanczos");
    }
    result.residual = std::max(result.residual, residual);
  }
  result.vectors = pairs.root().cwiseInverse().asDiagonal() * y;
  fix_signs(result.vectors);
  return result;
}

/// Of the first `complete` eigenvectors, a basis of each eigenspace that diagonalises S in place;
/// returns which of them are smooth.
std::vector<Index> tell_checkerboards_apart(Spectrum& s, const SparseMatrix& S, Index complete,
                                            double shift) {
  std::vector<Index> smooth;
  for (Index first = 0, last = 0; first < complete; first = last) {
    for (last = first + 1; last < complete; ++last) {
      if (is_gap(s.values[last - 1], s.values[last], shift)) break;
    }
    auto space = s.vectors.middleCols(first, last - first);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> share(space.transpose() * (S * space));
    space = (space * share.eigenvectors()).eval();
    for (Index k = first; k < last; ++k) {
      const double checkerboard = share.eigenvalues()[k - first];
      if (checkerboard <= 0.25) {
        smooth.push_back(k);
      } else if (checkerboard < 0.75) {
        throw SolverError("spectrum: eigenvector " + std::to_string(k) + " is " +
                          std::to_string(checkerboard) +
                          " checkerboard, neither smooth nor one: without stabilisation the "
                          "parities of this surface have spectra of their own; choose one");
      }
    }
  }
  return smooth;
}

/// The power of two next to the mean size of x: 1 where x is 0.
double magnitude(const Eigen::VectorXd& x) {
  const double mean = x.cwiseAbs().mean();
  return mean > 0 ? std::exp2(std::round(std::log2(mean))) : 1.;
}

/// Where A and the masses are of size 1; Lanczos compares with absolute thresholds.
Spectrum lowest_of_scaled(const SparseMatrix& A, const Eigen::VectorXd& mass,
                          const SpectrumOptions& options, const Context& context) {
  LowestPairs pairs(A, mass, context);
  Index rounds = 0;
  Index recovered = 0;
  if (A.rows() <= std::max(kDense, 3 * (options.count + kGuard))) {
    pairs.solve_dense();
  } else {
    pairs.extend(options.count + kGuard);
    for (rounds = 1;; ++rounds) {
      const Index j = first_gap(pairs.found().values, options.count, pairs.shift());
      const Index missing = j == 0 ? 0 : missing_below_gap(pairs, j);
      if (j > 0 && missing == 0) break;
      if (rounds == kRounds) {
        throw SolverError("spectrum: the lowest " + std::to_string(options.count) +
                          " eigenvalues were not complete after " + std::to_string(kRounds) +
                          " runs; ask for a few more or fewer");
      }
      recovered = std::max(recovered, missing);
      pairs.extend(missing + kGuard);
    }
  }
  Spectrum result = finish(pairs, options.count, options.tolerance, context);
  result.rounds = rounds;
  result.copies_recovered = recovered;
  return result;
}

}  // namespace

Spectrum lowest_spectrum(const SparseMatrix& A, const Eigen::VectorXd& mass,
                         const SpectrumOptions& options, const Context& context) {
  check_input(A, mass, options);
  context.begin("spectrum");
  context.check();
  // Both scaled, and A once more with its shift.
  context.need("spectrum", 4 * matrix_bytes(A) + 40 * A.rows());
  const double a = magnitude(A.diagonal());
  const double m = magnitude(mass);
  Spectrum result = lowest_of_scaled((1. / a) * A, (1. / m) * mass, options, context);
  result.values *= a / m;
  result.vectors /= std::sqrt(m);
  return result;
}

Spectrum lowest_smooth_spectrum(const SparseMatrix& A, const Eigen::VectorXd& mass,
                                const SparseMatrix& S, const SpectrumOptions& options,
                                const Context& context) {
  const Index n = A.rows();
  if (S.rows() != n || S.cols() != n) {
    throw UsageError("spectrum: the form of the checkerboards is that of another surface");
  }
  SpectrumOptions more = options;
  more.count = std::min(n, 2 * options.count + 2);
  for (;; more.count = std::min(n, 2 * more.count)) {
    Spectrum all = lowest_spectrum(A, mass, more, context);
    // Copies that the last eigenvalue may have beyond would leave its eigenspace incomplete.
    const double shift = -1. / mass.sum();
    Index complete = more.count;
    if (more.count < n) {
      do {
        --complete;
      } while (complete > 0 && !is_gap(all.values[complete - 1], all.values[complete], shift));
    }
    const std::vector<Index> smooth = tell_checkerboards_apart(all, S, complete, shift);
    if (static_cast<Index>(smooth.size()) < options.count && more.count < n) continue;
    if (static_cast<Index>(smooth.size()) < options.count) {
      throw UsageError("spectrum: " + std::to_string(options.count) + " eigenvalues, of " +
                       std::to_string(smooth.size()) + " that are no checkerboards; ask for fewer");
    }
    Spectrum result = all;
    result.values.resize(options.count);
    result.vectors.resize(n, options.count);
    for (Index k = 0; k < options.count; ++k) {
      result.values[k] = all.values[smooth[static_cast<std::size_t>(k)]];
      result.vectors.col(k) = all.vectors.col(smooth[static_cast<std::size_t>(k)]);
    }
    fix_signs(result.vectors);
    result.checkerboards = smooth[static_cast<std::size_t>(options.count - 1)] + 1 - options.count;
    return result;
  }
}

}  // namespace dsc
