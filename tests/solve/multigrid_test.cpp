#include "libdsc/solve/multigrid.h"

#include "libdsc/base/error.h"
#include "libdsc/solve/spd_solver.h"
#include "tests/solve/grid_systems.h"

#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace dsc {
namespace {

using Eigen::VectorXd;
using Triplets = std::vector<Eigen::Triplet<double>>;

VectorXd random_vector(Index n, unsigned seed) {
  std::mt19937 generator(seed);
  VectorXd v(n);
  for (double& value : v) value = static_cast<double>(generator()) / 2147483648.0 - 1.0;
  return v;
}

/// An nx x ny grid of rectangles of aspect ratio rho: vertex (i, j) is j * nx + i.
struct Grid {
  int nx, ny;
  double rho = 1.0, lambda = 0.25;

  int id(int i, int j) const { return j * nx + i; }
  Index size() const { return Index{nx} * ny; }

  /// The energy a |G phi|^2 + lambda (g . phi)^2 of the surfel calculus on one flat face, as sums
  /// of squares of the mean differences: the matrices below are its Hessians.
  SparseMatrix negated_laplacian(double diagonal = 0.0, int first = 0, Index total = 0) const {
    Triplets t;
    const auto square = [&](double weight, std::array<int, 4> corner, std::array<double, 4> row) {
      for (int a = 0; a < 4; ++a) {
        for (int b = 0; b < 4; ++b) {
          t.emplace_back(first + corner[a], first + corner[b], weight * row[a] * row[b]);
        }
      }
    };
    for (int j = 0; j + 1 < ny; ++j) {
      for (int i = 0; i + 1 < nx; ++i) {
        const std::array<int, 4> corner{id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)};
        square(rho, corner, {-0.5, 0.5, 0.5, -0.5});
        square(1 / rho, corner, {-0.5, -0.5, 0.5, 0.5});
        square(lambda, corner, {1, -1, 1, -1});
      }
    }
    const Index n = total == 0 ? size() : total;
    for (Index i = 0; i < size() && diagonal != 0; ++i) {
      t.emplace_back(first + static_cast<int>(i), first + static_cast<int>(i), diagonal);
    }
    SparseMatrix a(n, n);
    a.setFromTriplets(t.begin(), t.end());
    return a;
  }

  /// The same operator without a matrix: face by face, from differences.
  VectorXd apply(const VectorXd& x, double diagonal = 0.0) const {
    VectorXd y = diagonal * x;
    for (int j = 0; j + 1 < ny; ++j) {
      for (int i = 0; i + 1 < nx; ++i) {
        const double bottom = x[id(i + 1, j)] - x[id(i, j)];
        const double top = x[id(i + 1, j + 1)] - x[id(i, j + 1)];
        const double left = x[id(i, j + 1)] - x[id(i, j)];
        const double right = x[id(i + 1, j + 1)] - x[id(i + 1, j)];
        const double p = rho * (bottom + top) / 4, q = (left + right) / (4 * rho);
        const double g = lambda * (top - bottom);
        y[id(i, j)] += -p - q + g;
        y[id(i + 1, j)] += p - q - g;
        y[id(i, j + 1)] += -p + q - g;
        y[id(i + 1, j + 1)] += p + q + g;
      }
    }
    return y;
  }
};

/// The five-point stencil with couplings -weight_x and -weight_y and Dirichlet values eliminated.
SparseMatrix five_point(int n, double weight_x, double weight_y) {
  Triplets t;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int v = j * n + i;
      t.emplace_back(v, v, 2 * (weight_x + weight_y));
      if (i > 0) t.emplace_back(v, v - 1, -weight_x);
      if (i + 1 < n) t.emplace_back(v, v + 1, -weight_x);
      if (j > 0) t.emplace_back(v, v - n, -weight_y);
      if (j + 1 < n) t.emplace_back(v, v + n, -weight_y);
    }
  }
  SparseMatrix a(n * n, n * n);
  a.setFromTriplets(t.begin(), t.end());
  return a;
}

TEST(Multigrid, FindsTheManufacturedSolutionOfADefiniteSystem) {
  const Grid grid{91, 67};
  const VectorXd x = random_vector(grid.size(), 1);
  const MultigridSolver solver(grid.negated_laplacian(0.01));
  EXPECT_EQ(solver.report().singular_components, 0);
  EXPECT_GE(solver.report().levels, 2);
  const auto solution = solver.solve(grid.apply(x, 0.01), nullptr, 1e-11);
  EXPECT_LT((solution.x - x).norm(), 1e-8 * x.norm());
}

TEST(Multigrid, FindsTheManufacturedSolutionOfASingularSystemUpToItsMean) {
  const Grid grid{91, 67};
  VectorXd x = random_vector(grid.size(), 2);
  const MultigridSolver solver(grid.negated_laplacian());
  EXPECT_EQ(solver.report().singular_components, 1);
  const auto solution = solver.solve(grid.apply(x), nullptr, 1e-11);
  EXPECT_LT(std::abs(solution.x.mean()), 1e-12);
  x.array() -= x.mean();
  EXPECT_LT((solution.x - x).norm(), 1e-7 * x.norm());
  EXPECT_LT(solution.incompatibility, 1e-14);
}

TEST(Multigrid, TheResidualReportedIsTheTrueOneAndMeetsTheTolerance) {
  const Grid grid{80, 80};
  VectorXd b = random_vector(grid.size(), 3);
  b.array() -= b.mean();
  const MultigridSolver solver(grid.negated_laplacian());
  for (const double tolerance : {1e-2, 1e-6, 1e-11}) {
    const auto solution = solver.solve(b, nullptr, tolerance);
    const double residual = (b - grid.apply(solution.x)).norm() / b.norm();
    EXPECT_LE(residual, 1.01 * tolerance);
    EXPECT_NEAR(solution.relative_residual, residual, 1e-13);
  }
}

TEST(Multigrid, AgreesWithADirectSolver) {
  const SparseMatrix a = five_point(60, 1.0, 1.0);
  const VectorXd b = random_vector(a.rows(), 4);
  const Eigen::SimplicialLDLT<SparseMatrix> direct(a);
  const VectorXd x = direct.solve(b);
  const auto solution = MultigridSolver(a).solve(b, nullptr, 1e-12);
  EXPECT_LT((solution.x - x).norm(), 1e-9 * x.norm());
}

TEST(Multigrid, IterationsHardlyGrowWithTheGrid) {
  for (const double rho : {1.0, 3.0}) {
    std::vector<int> iterations;
    for (const int n : {100, 200, 400}) {
      const Grid grid{n, n, rho};
      VectorXd b = random_vector(grid.size(), 5);
      b.array() -= b.mean();
      iterations.push_back(
          MultigridSolver(grid.negated_laplacian()).solve(b, nullptr, 1e-8).iterations);
    }
    // Unpreconditioned conjugate gradients would double at each step.
    EXPECT_LE(iterations[1], 1.35 * iterations[0]) << rho;
    EXPECT_LE(iterations[2], 1.35 * iterations[1]) << rho;
  }
}

TEST(Multigrid, StretchedCouplingsConverge) {
  for (const SparseMatrix& a : {five_point(150, 1.0, 25.0), Grid{150, 150, 5.0}.negated_laplacian(),
                                Grid{150, 150, 25.0, 0.5}.negated_laplacian(1e-4)}) {
    VectorXd b = random_vector(a.rows(), 6);
    b.array() -= b.mean();
    const auto solution = MultigridSolver(a).solve(b, nullptr, 1e-8);
    EXPECT_LT((b - a * solution.x).norm(), 1.01e-8 * b.norm());
  }
}

TEST(Multigrid, BitsDoNotDependOnThreads) {
  const Grid grid{160, 150};
  const SparseMatrix a = grid.negated_laplacian();
  const VectorXd b = grid.apply(random_vector(grid.size(), 7));
  const auto solve = [&](int threads) {
    const Context context{threads};
    return MultigridSolver(a, {}, context).solve(b, nullptr, 1e-9, context).x;
  };
  const VectorXd one = solve(1);
  for (const int threads : {2, 4, 8}) EXPECT_TRUE(one == solve(threads)) << threads;
}

/// Two grids, one of them with a diagonal term, an isolated vertex and a lone definite unknown.
struct Patchwork {
  Grid first{40, 50}, second{45, 30};
  Index total = first.size() + second.size() + 3;
  SparseMatrix matrix() const {
    SparseMatrix a = first.negated_laplacian(0, 0, total);
    a += second.negated_laplacian(0, static_cast<int>(first.size()), total);
    SparseMatrix lone(total, total);
    lone.insert(total - 1, total - 1) = 5.0;  // total - 3 and total - 2 keep empty rows
    a += lone;
    return a;
  }
};

TEST(Multigrid, EachSingularComponentHasItsOwnMean) {
  const Patchwork parts;
  const SparseMatrix a = parts.matrix();
  const MultigridSolver solver(a);
  EXPECT_EQ(solver.report().singular_components, 4);
  const Index n1 = parts.first.size(), n2 = parts.second.size();
  VectorXd b(parts.total);
  b << parts.first.apply(random_vector(n1, 8)), parts.second.apply(random_vector(n2, 9)), 0, 0, 10;
  const auto centred = solver.solve(b, nullptr, 1e-10).x;
  EXPECT_LT((a * centred - b).norm(), 1.01e-10 * b.norm());
  EXPECT_NEAR(centred.head(n1).mean(), 0, 1e-11);
  EXPECT_NEAR(centred.segment(n1, n2).mean(), 0, 1e-11);
  EXPECT_EQ(centred[n1 + n2], 0);
  EXPECT_NEAR(centred[parts.total - 1], 2.0, 1e-8);

  VectorXd start = VectorXd::Constant(parts.total, 3.0);
  start.segment(n1, n2).setConstant(-7.0);
  const auto shifted = solver.solve(b, &start, 1e-10).x;
  EXPECT_NEAR(shifted.head(n1).mean(), 3, 1e-10);
  EXPECT_NEAR(shifted.segment(n1, n2).mean(), -7, 1e-10);
  EXPECT_EQ(shifted[n1 + n2], 3);
  EXPECT_NEAR(shifted[parts.total - 1], 2.0, 1e-8);
}

TEST(Multigrid, ManySmallComponentsNeedNoCoarseSpace) {
  const Grid piece{4, 3};
  const int pieces = 700;
  const Index total = pieces * piece.size();
  Triplets t;
  const SparseMatrix block = piece.negated_laplacian();
  VectorXd b(total);
  for (int c = 0; c < pieces; ++c) {
    const int first = c * static_cast<int>(piece.size());
    for (int j = 0; j < block.outerSize(); ++j) {
      for (SparseMatrix::InnerIterator e(block, j); e; ++e) {
        t.emplace_back(first + e.row(), first + e.col(), e.value());
      }
    }
    b.segment(first, piece.size()) = piece.apply(random_vector(piece.size(), 10 + c));
  }
  SparseMatrix a(total, total);
  a.setFromTriplets(t.begin(), t.end());
  MultigridOptions options;
  options.coarse_size = 20;
  const MultigridSolver solver(a, options);
  EXPECT_EQ(solver.report().singular_components, pieces);
  const auto solution = solver.solve(b, nullptr, 1e-10);
  EXPECT_LT((a * solution.x - b).norm(), 1.01e-10 * b.norm());
}

TEST(Multigrid, CouplingsOfRoundingSizeDoNotConnect) {
  // lambda = 0 on squares couples along diagonals only: black and white vertices do not meet.
  const Grid checkerboard{30, 30, 1.0, 1e-17};
  EXPECT_EQ(MultigridSolver(checkerboard.negated_laplacian()).report().singular_components, 2);
}

TEST(Multigrid, ADominantDiagonalNeedsNoHierarchy) {
  const Grid grid{50, 50};
  const VectorXd x = random_vector(grid.size(), 11);
  MultigridOptions options;
  options.coarse_size = 10;
  const auto solution = MultigridSolver(grid.negated_laplacian(100.0), options)
                            .solve(grid.apply(x, 100.0), nullptr, 1e-12);
  EXPECT_LT((solution.x - x).norm(), 1e-10 * x.norm());
}

TEST(Multigrid, TheScaleOfTheSystemDoesNotMatter) {
  const Grid grid{60, 60};
  const SparseMatrix a = grid.negated_laplacian(0.1);
  const VectorXd b = grid.apply(random_vector(grid.size(), 12), 0.1);
  const VectorXd x = MultigridSolver(a).solve(b, nullptr, 1e-10).x;
  for (const double scale : {std::ldexp(1.0, -130), std::ldexp(1.0, 150)}) {
    const MultigridSolver solver(SparseMatrix(scale * a));
    EXPECT_TRUE(solver.solve(scale * b, nullptr, 1e-10).x == x) << scale;
    EXPECT_TRUE(solver.solve(b, nullptr, 1e-10).x == x / scale) << scale;
  }
}

TEST(Multigrid, AGoodStartSavesIterations) {
  const Grid grid{80, 80};
  const VectorXd x = random_vector(grid.size(), 13);
  const VectorXd b = grid.apply(x, 0.001);
  const MultigridSolver solver(grid.negated_laplacian(0.001));
  EXPECT_EQ(solver.solve(b, &x, 1e-10).iterations, 0);
  const VectorXd near = x + 1e-5 * random_vector(grid.size(), 14);
  EXPECT_LT(solver.solve(b, &near, 1e-10).iterations, solver.solve(b, nullptr, 1e-10).iterations);
}

TEST(Multigrid, SmallestSystems) {
  SparseMatrix one(1, 1);
  EXPECT_EQ(MultigridSolver(one).solve(VectorXd::Zero(1), nullptr, 1e-6).x[0], 0);
  one.insert(0, 0) = 4.0;
  EXPECT_NEAR(MultigridSolver(one).solve(VectorXd::Constant(1, 8.0), nullptr, 1e-6).x[0], 2.0,
              2e-6);
  EXPECT_EQ(MultigridSolver(SparseMatrix(0, 0)).solve(VectorXd(0), nullptr, 1e-6).x.size(), 0);
  EXPECT_EQ(MultigridSolver(SparseMatrix(3, 3)).solve(VectorXd::Zero(3), nullptr, 1e-6).x.size(),
            3);
}

TEST(Multigrid, AZeroRightHandSideGivesZero) {
  const Grid grid{40, 40};
  const VectorXd start = random_vector(grid.size(), 15);
  const VectorXd zero = VectorXd::Zero(grid.size());
  const auto definite = MultigridSolver(grid.negated_laplacian(1.0)).solve(zero, &start, 1e-6);
  EXPECT_TRUE(definite.x == zero);
  EXPECT_EQ(definite.relative_residual, 0);
  const auto singular = MultigridSolver(grid.negated_laplacian()).solve(zero, nullptr, 1e-6);
  EXPECT_TRUE(singular.x == zero);
}

TEST(Multigrid, AnIncompatibleRightHandSideIsRefused) {
  const Grid grid{40, 40};
  const MultigridSolver solver(grid.negated_laplacian());
  VectorXd b = grid.apply(random_vector(grid.size(), 16));
  EXPECT_THROW(solver.solve(b.array() + 1e-3, nullptr, 1e-6), SolverError);
  const double offset = 1e-9 * b.norm() / 40;  // of norm 1e-9 |b| on 1600 unknowns
  const auto solution = solver.solve(b.array() + offset, nullptr, 1e-6);
  EXPECT_NEAR(solution.incompatibility, 1e-9, 1e-12);
}

TEST(Multigrid, BadInputIsRefused) {
  const Grid grid{40, 40};
  const SparseMatrix a = grid.negated_laplacian(1.0);
  const MultigridSolver solver(a);
  VectorXd b = VectorXd::Ones(grid.size());
  EXPECT_THROW(solver.solve(VectorXd::Ones(3), nullptr, 1e-6), UsageError);
  EXPECT_THROW(solver.solve(b, nullptr, 0.0), UsageError);
  EXPECT_THROW(solver.solve(b, nullptr, std::nan("")), UsageError);
  const VectorXd good = b;
  b[77] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(solver.solve(b, nullptr, 1e-6), SolverError);
  EXPECT_THROW(solver.solve(good, &b, 1e-6), SolverError);
  EXPECT_THROW(solver.solve(random_vector(grid.size(), 19), nullptr, 1e-18), SolverError);

  EXPECT_THROW(MultigridSolver(SparseMatrix(3, 4)), UsageError);
  EXPECT_THROW(MultigridSolver(SparseMatrix(a.triangularView<Eigen::Lower>())), UsageError);
  SparseMatrix infinite = a;
  infinite.coeffRef(5, 5) = std::numeric_limits<double>::infinity();
  EXPECT_THROW(MultigridSolver{infinite}, SolverError);
  MultigridOptions options;
  options.smoothing_degree = 0;
  EXPECT_THROW(MultigridSolver(a, options), UsageError);
}

TEST(Multigrid, AnIndefiniteMatrixIsRefused) {
  const Grid grid{40, 40};
  // The Laplacian with the wrong sign, and a shift below zero, which constants see.
  EXPECT_THROW(MultigridSolver(SparseMatrix(-grid.negated_laplacian())), SolverError);
  EXPECT_THROW(MultigridSolver(grid.negated_laplacian(-1e-3)), SolverError);
  // One negative eigenvalue that neither the diagonal nor the sum of entries shows.
  SparseMatrix a = grid.negated_laplacian();
  a.coeffRef(0, 0) += 30.0;
  a.coeffRef(820, 820) -= 2.9;
  const VectorXd b = random_vector(grid.size(), 17);
  for (const Index coarse_size : {1, 10, 5000}) {
    MultigridOptions options;
    options.coarse_size = coarse_size;
    EXPECT_THROW(MultigridSolver(a, options).solve(b, nullptr, 1e-8), SolverError) << coarse_size;
  }
}

TEST(Multigrid, CancellationStopsASolve) {
  class StopsDuringSolve : public Monitor {
    void begin(std::string_view stage, Index) override {
      if (stage == "solve") cancel();
    }
  } monitor;
  const Grid grid{40, 40};
  const Context context{1, &monitor};
  const MultigridSolver solver(grid.negated_laplacian(1.0), {}, context);
  EXPECT_THROW(solver.solve(VectorXd::Ones(grid.size()), nullptr, 1e-6, context), Cancelled);
}

TEST(Multigrid, ProgressAddsUpToItsTotal) {
  class Sum : public Monitor {
   public:
    Index total = 0, done = 0;

   private:
    void begin(std::string_view, Index units) override { total = units, done = 0; }
    void advance(Index units) noexcept override { done += units; }
  } monitor;
  const Grid grid{60, 60};
  const Context context{2, &monitor};
  const MultigridSolver solver(grid.negated_laplacian(0.01), {}, context);
  solver.solve(random_vector(grid.size(), 18), nullptr, 1e-8, context);
  EXPECT_GT(monitor.total, 0);
  EXPECT_EQ(monitor.done, monitor.total);
}

TEST(Multigrid, AGuessFarOffCostsNoAccuracy) {
  const SparseMatrix A = testing::grid_laplacian(60, 60) + 0.01 * testing::identity(3600);
  const auto solver = make_spd_solver(A, {.method = SolverMethod::multigrid});
  const Eigen::VectorXd b = testing::scrambled(3600);
  const Solution far = solver->solve(b, 1e12 * testing::scrambled(3600, 5));
  EXPECT_LE((b - A * far.x).norm(), 1e-9 * b.norm());
}

TEST(Multigrid, WhereItStallsTheAutomaticSolverFactorizes) {
  // A chain whose springs differ by six orders of magnitude: no coarse grid knows its modes, but
  // a factorization is exact.
  const Index n = kDirectLimit + 1;
  Triplets entries;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> order(-3, 3);
  for (Index i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 1e-4);
    if (i + 1 == n) break;
    const double spring = std::pow(10., order(random));
    for (const Index a : {i, i + 1}) {
      entries.emplace_back(a, a, spring);
      entries.emplace_back(a, 2 * i + 1 - a, -spring);
    }
  }
  SparseMatrix A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  const VectorXd b = A * testing::scrambled(n);
  const auto solver = make_spd_solver(A, {.method = SolverMethod::automatic, .tolerance = 1e-12});
  const Solution solution = solver->solve(b);
  EXPECT_LE((b - A * solution.x).norm(), 1e-12 * b.norm());
  EXPECT_LE(solution.iterations, 1);  // those of a factorization: multigrid did stall
}

}  // namespace
}  // namespace dsc
