// Systems that have no answer, or hardly one, by every method: an error, or an answer whose
// residual is what is promised, summed here once more in long doubles.
#include "libdsc/solve/matrix_free.h"
#include "libdsc/solve/multigrid.h"
#include "libdsc/solve/spectrum.h"
#include "tests/solve/solvers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace dsc {
namespace {

using testing::grid_laplacian;
using testing::identity;
using testing::scrambled;

constexpr double kTolerance = 1e-9;

/// ||b - A x|| / ||b|| in long doubles, whose exponents hold any square.
long double true_residual(const SparseMatrix& A, const Eigen::VectorXd& x,
                          const Eigen::VectorXd& b) {
  std::vector<long double> r(b.data(), b.data() + b.size());
  for (int c = 0; c < A.outerSize(); ++c) {
    for (SparseMatrix::InnerIterator it(A, c); it; ++it) {
      r[static_cast<std::size_t>(it.row())] -=
          static_cast<long double>(it.value()) * static_cast<long double>(x[c]);
    }
  }
  long double above = 0, below = 0;
  for (Index i = 0; i < b.size(); ++i) {
    above += r[static_cast<std::size_t>(i)] * r[static_cast<std::size_t>(i)];
    below += static_cast<long double>(b[i]) * static_cast<long double>(b[i]);
  }
  return std::sqrt(above / below);
}

struct Answer {
  Eigen::VectorXd x;
  double reported = 0;
};

struct Method {
  const char* name;
  std::function<Answer(const SparseMatrix&, const Eigen::VectorXd&)> solve;
};

Answer solve_spd(const SpdSolverFactory& factory, const SparseMatrix& A, const Eigen::VectorXd& b,
                 SolverMethod method) {
  const Solution s = factory(A, {method, kTolerance}, {})->solve(b);
  return {s.x, s.relative_residual};
}

const Method kMethods[] = {
    {"ldlt", [](const auto& A,
                const auto& b) { return solve_spd(make_spd_solver, A, b, SolverMethod::ldlt); }},
    {"multigrid",
     [](const auto& A, const auto& b) {
       return solve_spd(make_spd_solver, A, b, SolverMethod::multigrid);
     }},
    {"automatic",
     [](const auto& A, const auto& b) {
       return solve_spd(make_spd_solver, A, b, SolverMethod::automatic);
     }},
#ifdef DSC_TEST_CHOLMOD
    {"cholmod",
     [](const auto& A, const auto& b) {
       return solve_spd(make_cholmod_solver, A, b, SolverMethod::ldlt);
     }},
#endif
    {"matrix free",
     [](const SparseMatrix& A, const Eigen::VectorXd& b) {
       const auto product = [&](const Eigen::VectorXd& x, Eigen::VectorXd& y) { y = A * x; };
       const auto nothing = [](const Eigen::VectorXd& x, Eigen::VectorXd& y) { y = x; };
       MatrixFreeOptions options;
       options.residual = kTolerance * b.stableNorm();
       options.max_iterations = 3000;
       const MatrixFreeSolution s =
           solve_matrix_free(product, nothing, b, Eigen::VectorXd::Zero(b.size()), options);
       return Answer{s.x, s.residual / b.stableNorm()};
     }},
};

/// Nothing, or what an answer lacks of what is promised.
std::string fault(const Answer& answer, const SparseMatrix& A, const Eigen::VectorXd& b) {
  if (!answer.x.allFinite()) return "the answer is not finite";
  const long double residual = true_residual(A, answer.x, b);
  if (!(residual <= 1.01L * kTolerance))
    return "its residual is " + std::to_string(std::log10(residual));
  // Two sums of the same terms may differ by rounding, which the largest of them decides.
  const double terms = (A.cwiseAbs() * answer.x.cwiseAbs()).stableNorm() / b.stableNorm();
  const long double rounding = 1e-15L * (1 + static_cast<long double>(terms));
  if (!(std::abs(residual - static_cast<long double>(answer.reported)) <=
        0.01L * residual + rounding)) {
    return "its residual is 1e" + std::to_string(std::log10(residual)) + ", the report says 1e" +
           std::to_string(std::log10(answer.reported));
  }
  return "";
}

struct System {
  std::string name;
  SparseMatrix A;
};

SparseMatrix congruent(const SparseMatrix& A, const Eigen::VectorXd& d) {
  return d.asDiagonal() * A * d.asDiagonal();
}

/// Positive weights of very different sizes, 10^-decades to 10^decades.
Eigen::VectorXd spread(Index n, double decades) {
  return (scrambled(n, 9).array() * decades * std::log(10.)).exp();
}

/// 1 at one place.
SparseMatrix single(Index n, Index place, double value) {
  SparseMatrix E(n, n);
  E.insert(place, place) = value;
  return E;
}

std::vector<System> systems_without_an_answer() {
  const Index n = 30, N = n * n;
  const SparseMatrix L = grid_laplacian(n, n), I = identity(N);
  std::vector<System> systems = {
      {"the Laplacian", L},
      {"two Laplacians, one of them fixed", grid_laplacian(n, n, 2) + single(2 * N, 0, 1)},
      {"a Laplacian in other units", congruent(L, Eigen::VectorXd::Constant(N, 1e-120))},
      {"nothing", SparseMatrix(N, N)},
      {"one negative eigenvalue", L - 1e-3 * I},
      {"many negative eigenvalues", L - 0.7 * I},
      {"a negative matrix", SparseMatrix(-(L + I))},
      {"a saddle", L + I - single(N, 333, 20)},
  };
  SparseMatrix empty_row = L + I;
  for (Index c = 0; c < N; ++c) {
    for (SparseMatrix::InnerIterator it(empty_row, c); it; ++it) {
      if (it.row() == 17 || c == 17) it.valueRef() = 0;
    }
  }
  systems.push_back({"an empty row", empty_row});
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    systems.push_back({"a diagonal entry of " + std::to_string(bad), L + I + single(N, 333, bad)});
    SparseMatrix off = L + I;
    off.coeffRef(4, 5) = off.coeffRef(5, 4) = bad;
    systems.push_back({"couplings of " + std::to_string(bad), off});
  }
  SparseMatrix skew = L + I;
  skew.coeffRef(3, 4) += 0.5;
  systems.push_back({"an unsymmetric matrix", skew});
  return systems;
}

TEST(HostileSystems, WithoutAnAnswerAreErrorsByEveryMethod) {
  for (const System& system : systems_without_an_answer()) {
    for (const Method& method : kMethods) {
      // Conjugate gradients know the matrix by its products alone: an unsymmetric one may have an
      // answer there, with the residual promised.
      const bool may_answer = system.name == "an unsymmetric matrix";
      for (const std::uint64_t seed : {1, 2}) {
        const Eigen::VectorXd b = scrambled(system.A.rows(), seed);
        try {
          const Answer answer = method.solve(system.A, b);
          const std::string what = fault(answer, system.A, b);
          EXPECT_TRUE(may_answer && what.empty())
              << method.name << " answered for " << system.name << ": " << what;
        } catch (const SolverError&) {
        } catch (const UsageError&) {
          EXPECT_TRUE(may_answer) << method.name << ", " << system.name;
        }
      }
    }
  }
}

TEST(HostileSystems, BadlyScaledOnesHaveTheResidualPromisedOrAreErrors) {
  const Index n = 20, N = n * n;
  const SparseMatrix A = grid_laplacian(n, n) + 0.01 * identity(N);
  std::vector<System> systems;
  for (const double decades : {1., 3., 6., 12., 40., 80.}) {
    const std::string d = std::to_string(decades);
    systems.push_back({"unknowns of 10^+-" + d, congruent(A, spread(N, decades))});
    SparseMatrix heavy = A;
    heavy.diagonal() += spread(N, decades);
    systems.push_back({"masses of 10^+-" + d, heavy});
    for (const double sign : {-1., 1.}) {
      const double unit = std::pow(10., sign * decades);
      systems.push_back({"all times " + std::to_string(unit), unit * A});
    }
  }
  for (const double shift : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e-18}) {
    systems.push_back({"nearly singular", grid_laplacian(n, n) + shift * identity(N)});
  }
  int answers = 0;
  for (const System& system : systems) {
    for (const Method& method : kMethods) {
      for (const double unit : {1., 1e-200, 1e200}) {
        const Eigen::VectorXd b = unit * scrambled(N);
        try {
          const Answer answer = method.solve(system.A, b);
          ++answers;
          EXPECT_EQ(fault(answer, system.A, b), "")
              << method.name << ", " << system.name << ", b " << unit;
        } catch (const SolverError&) {
        }
      }
    }
  }
  EXPECT_GT(answers, 100);  // most of them are soluble
}

TEST(HostileSystems, RightHandSidesThatAreNotFiniteAreErrors) {
  const SparseMatrix A = grid_laplacian(20, 20) + identity(400);
  for (const Method& method : kMethods) {
    for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
      Eigen::VectorXd b = scrambled(400);
      b[123] = bad;
      EXPECT_THROW((void)method.solve(A, b), Error) << method.name;
    }
  }
}

/// Of the Laplacian alone, singular as it is.
TEST(HostileSystems, MultigridOnASingularMatrixReportsWhatItTookAway) {
  const SparseMatrix L = grid_laplacian(40, 40);
  const MultigridSolver solver(L);
  EXPECT_EQ(solver.report().singular_components, 1);
  Eigen::VectorXd b = scrambled(1600);
  EXPECT_THROW((void)solver.solve(b, nullptr, 1e-10), SolverError);
  b.array() -= b.mean();
  const auto s = solver.solve(b, nullptr, 1e-10);
  EXPECT_LE(true_residual(L, s.x, b), 1.01e-10L);
  EXPECT_LE(s.incompatibility, 1e-12);
}

TEST(HostileSystems, SpectraAreCompleteOrErrors) {
  const Index n = 25, N = n * n;
  const SparseMatrix L = grid_laplacian(n, n);
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(N);
  const SpectrumOptions options{.count = 6};
  std::vector<System> bad = {
      {"an indefinite matrix", L - 0.5 * identity(N)},
      {"a negative matrix", SparseMatrix(-L)},
      {"NaN", L + single(N, 40, std::nan(""))},
      {"infinity", L + single(N, 40, INFINITY)},
  };
  SparseMatrix skew = L;
  skew.coeffRef(3, 4) += 0.5;
  bad.push_back({"an unsymmetric matrix", skew});
  for (const System& system : bad) {
    EXPECT_THROW((void)lowest_spectrum(system.A, one, options), SolverError) << system.name;
  }
  for (const double bad_mass : {0., -1., std::nan(""), HUGE_VAL}) {
    Eigen::VectorXd mass = one;
    mass[7] = bad_mass;
    EXPECT_THROW((void)lowest_spectrum(L, mass, options), InputError) << bad_mass;
  }
  for (const double decades : {1., 2., 4., 8., 16., 80.}) {
    const Eigen::VectorXd mass = spread(N, decades);
    try {
      const Spectrum s = lowest_spectrum(L, mass, options);
      const Eigen::MatrixXd gram = s.vectors.transpose() * mass.asDiagonal() * s.vectors;
      EXPECT_LT((gram - Eigen::MatrixXd::Identity(6, 6)).norm(), 1e-8) << decades;
      const double shift = -1. / mass.sum();
      for (Index k = 0; k < 6; ++k) {
        const Eigen::VectorXd r =
            L * s.vectors.col(k) - s.values[k] * mass.cwiseProduct(s.vectors.col(k));
        const double residual = r.cwiseQuotient(mass.cwiseSqrt()).norm() / (s.values[k] - shift);
        EXPECT_LE(residual, 1.5e-7) << decades;
        EXPECT_LE(residual, 1.5 * s.residual + 1e-9) << decades;
      }
    } catch (const SolverError&) {
    }
  }
}

}  // namespace
}  // namespace dsc
