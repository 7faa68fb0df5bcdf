#include "libdsc/solve/matrix_free.h"

#include "libdsc/base/error.h"

#include <gtest/gtest.h>
#include <Eigen/Dense>

namespace dsc {
namespace {

Eigen::MatrixXd random_spd(Index n) {
  srand(2);
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(n, n);
  return a * a.transpose() + 0.1 * Eigen::MatrixXd::Identity(n, n);
}

void copy(const Eigen::VectorXd& r, Eigen::VectorXd& z) { z = r; }

TEST(MatrixFree, ReachesTheResidualAskedForWithAnyPreconditioner) {
  const Eigen::MatrixXd A = random_spd(40);
  const Eigen::VectorXd b = Eigen::VectorXd::Random(40), start = Eigen::VectorXd::Random(40);
  const Eigen::VectorXd scale = A.diagonal().cwiseInverse();
  const auto apply = [&](const Eigen::VectorXd& x, Eigen::VectorXd& y) { y = A * x; };
  for (const bool scaled : {false, true}) {
    const auto precondition = [&](const Eigen::VectorXd& r, Eigen::VectorXd& z) {
      z = scaled ? r.cwiseProduct(scale).eval() : r;
    };
    const MatrixFreeSolution s = solve_matrix_free(apply, precondition, b, start, {1e-10, 1000});
    EXPECT_LE((b - A * s.x).norm(), 1.01e-10);
    EXPECT_NEAR((b - A * s.x).norm(), s.residual, 1e-12);
    EXPECT_GT(s.iterations, 10);
  }
}

TEST(MatrixFree, AGuessThatServesCostsNothing) {
  const auto twice = [](const Eigen::VectorXd& x, Eigen::VectorXd& y) { y = 2 * x; };
  const MatrixFreeSolution s = solve_matrix_free(twice, copy, Eigen::Vector3d(2, 4, 6),
                                                 Eigen::Vector3d(1, 2, 3), {1e-12, 5});
  EXPECT_EQ(s.iterations, 0);
  EXPECT_EQ(s.x, Eigen::Vector3d(1, 2, 3));
}

TEST(MatrixFree, NeverAnswersForASystemItCannotSolve) {
  const auto negative = [](const Eigen::VectorXd& x, Eigen::VectorXd& y) { y = -x; };
  const Eigen::VectorXd b = Eigen::Vector3d(1, 2, 3), zero = Eigen::Vector3d::Zero();
  EXPECT_THROW(solve_matrix_free(negative, copy, b, zero, {1e-9, 10}), SolverError);
  EXPECT_THROW(solve_matrix_free(copy, negative, b, zero, {1e-9, 10}), SolverError);
  EXPECT_THROW(solve_matrix_free(copy, copy, b, zero, {0., 10}), UsageError);
  EXPECT_THROW(solve_matrix_free(copy, copy, b, Eigen::Vector2d(1, 1), {1e-9, 10}), UsageError);
  const Eigen::VectorXd nan = Eigen::Vector3d::Constant(std::nan(""));
  EXPECT_THROW(solve_matrix_free(copy, copy, nan, zero, {1e-9, 10}), SolverError);
  const Eigen::MatrixXd A = random_spd(40);
  const auto apply = [&](const Eigen::VectorXd& x, Eigen::VectorXd& y) { y = A * x; };
  EXPECT_THROW(solve_matrix_free(apply, copy, Eigen::VectorXd::Ones(40), Eigen::VectorXd::Zero(40),
                                 {1e-10, 3}),
               SolverError);
}

}  // namespace
}  // namespace dsc
