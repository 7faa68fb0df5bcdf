#include "tests/solve/solvers.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>
#include <limits>
#include <thread>

namespace dsc {
namespace {

using testing::grid_laplacian;
using testing::identity;
using testing::scrambled;

SparseMatrix shifted(Index n, Index m, double shift) {
  return grid_laplacian(n, m) + shift * identity(n * m);
}

struct Maker {
  const char* name;
  SpdSolverFactory make;
};

/// Every direct solver keeps the same promises.
class SpdSolvers : public ::testing::TestWithParam<Maker> {
 protected:
  static std::unique_ptr<SpdSolver> make(const SparseMatrix& A, const SolverOptions& options = {}) {
    return GetParam().make(A, options, {});
  }
};

TEST_P(SpdSolvers, AgreesWithADenseSolve) {
  const SparseMatrix A = shifted(9, 11, 0.1);
  const Eigen::VectorXd b = scrambled(A.rows());
  const Eigen::VectorXd expected = Eigen::MatrixXd(A).fullPivLu().solve(b);
  EXPECT_LT((make(A)->solve(b).x - expected).norm(), 1e-12 * expected.norm());
}

TEST_P(SpdSolvers, TheReportedResidualIsTheTrueOne) {
  for (const Index n : {3, 50}) {  // below and above the size that METIS orders
    const SparseMatrix A = shifted(n, n, 1e-6);
    const Eigen::VectorXd b = scrambled(A.rows());
    const Solution s = make(A)->solve(b);
    const double residual = (b - A * s.x).norm() / b.norm();
    EXPECT_LE(residual, 1e-9);
    // The residual is rounding itself, so two ways to sum it agree in size only.
    EXPECT_GE(s.relative_residual, 0.5 * residual);
    EXPECT_LE(s.relative_residual, 2 * residual);
  }
}

TEST_P(SpdSolvers, ResidualsOfTinyAndHugeRightHandSidesAreRelative) {
  const auto solver = make(shifted(20, 20, 0.5));
  const Eigen::VectorXd b = scrambled(400);
  const Eigen::VectorXd x = solver->solve(b).x;
  for (const double scale : {0x1p-900, 0x1p900}) {  // squares of these leave double's range
    const Solution s = solver->solve(scale * b);
    EXPECT_LE(s.relative_residual, 1e-9);
    EXPECT_EQ((s.x / scale - x).norm(), 0);  // powers of two only move exponents
  }
}

TEST_P(SpdSolvers, ZeroGivesZero) {
  const auto solver = make(shifted(5, 5, 1));
  EXPECT_EQ(solver->solve(Eigen::VectorXd::Zero(25), scrambled(25)).x.norm(), 0);
}

TEST_P(SpdSolvers, AGuessChangesTheAnswerByRoundingOnly) {
  const auto solver = make(shifted(20, 20, 0.5));
  const Eigen::VectorXd b = scrambled(400);
  EXPECT_LT((solver->solve(b, 100 * scrambled(400, 7)).x - solver->solve(b).x).norm(), 1e-9);
}

TEST_P(SpdSolvers, SingularMatricesAreRefused) {
  EXPECT_THROW(make(grid_laplacian(4, 5)), SolverError);
  EXPECT_THROW(make(grid_laplacian(60, 70)), SolverError);
  EXPECT_THROW(make(grid_laplacian(200, 200)), SolverError);
  EXPECT_THROW(make(SparseMatrix(3, 3)), SolverError);
  // One of two blocks is regular.
  SparseMatrix half = grid_laplacian(20, 20, 2);
  half.coeffRef(0, 0) += 1;
  EXPECT_THROW(make(half), SolverError);
}

TEST_P(SpdSolvers, IndefiniteAndNegativeMatricesAreRefused) {
  EXPECT_THROW(make(shifted(40, 40, -0.01)), SolverError);
  EXPECT_THROW(make(SparseMatrix(-shifted(40, 40, 1))), SolverError);
}

TEST_P(SpdSolvers, AnUnsymmetricMatrixIsNoSuccess) {
  SparseMatrix A = shifted(10, 10, 1);
  A.coeffRef(3, 4) += 0.5;  // the factorization sees one triangle, the residual both
  const auto attempt = [&] { make(A)->solve(scrambled(100)); };
  EXPECT_THROW(attempt(), SolverError);
}

TEST_P(SpdSolvers, NothingThatIsNotFiniteGetsThrough) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  SparseMatrix A = shifted(10, 10, 1);
  const auto solver = make(A);
  Eigen::VectorXd b = scrambled(100);
  b[17] = nan;
  EXPECT_THROW(solver->solve(b), SolverError);
  EXPECT_THROW(solver->solve(scrambled(100), b), SolverError);
  b[17] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(solver->solve(b), SolverError);
  A.coeffRef(3, 3) = nan;
  EXPECT_THROW(make(A), SolverError);
}

TEST_P(SpdSolvers, WrongShapesAndOptionsAreRefused) {
  EXPECT_THROW(make(SparseMatrix(3, 4)), UsageError);
  EXPECT_THROW(make(identity(3), {.tolerance = 0}), UsageError);
  EXPECT_THROW(make(identity(3))->solve(Eigen::VectorXd::Ones(4)), UsageError);
}

TEST_P(SpdSolvers, AToleranceBelowRoundingFailsLoudly) {
  const auto solver = make(shifted(40, 40, 1e-8), {.tolerance = 1e-300});
  EXPECT_THROW(solver->solve(scrambled(1600)), SolverError);
}

TEST_P(SpdSolvers, SolvesFromSeveralThreadsGiveTheSameBits) {
  const SparseMatrix A = shifted(50, 50, 0.01);
  const Eigen::VectorXd b = scrambled(2500);
  const Eigen::VectorXd x = make(A)->solve(b).x;
  std::vector<Eigen::VectorXd> results(4);
  std::vector<std::thread> threads;
  for (auto& r : results) threads.emplace_back([&] { r = make(A)->solve(b).x; });
  for (auto& t : threads) t.join();
  for (const auto& r : results) EXPECT_EQ((r - x).cwiseAbs().maxCoeff(), 0);
}

INSTANTIATE_TEST_SUITE_P(Direct, SpdSolvers,
                         ::testing::Values(
#ifdef DSC_TEST_CHOLMOD
                             Maker{"Cholmod", make_cholmod_solver},
#endif
                             Maker{"Ldlt", make_spd_solver}),
                         [](const auto& maker) { return maker.param.name; });

}  // namespace
}  // namespace dsc
