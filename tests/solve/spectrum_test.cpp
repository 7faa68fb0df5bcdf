#include "libdsc/solve/spectrum.h"

#include "libdsc/base/error.h"
#include "libdsc/solve/inertia.h"
#include "tests/solve/grid_systems.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace dsc {
namespace {

using testing::grid_laplacian;
using testing::identity;
using testing::scrambled;

/// All eigenvalues of `copies` grid graphs of n x m vertices: sums of those of two paths.
std::vector<double> grid_eigenvalues(Index n, Index m, Index copies = 1) {
  std::vector<double> values;
  const auto of_path = [](Index k, Index length) {
    return 2. -
           2. * std::cos(std::numbers::pi * static_cast<double>(k) / static_cast<double>(length));
  };
  for (Index c = 0; c < copies; ++c) {
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; j < m; ++j) values.push_back(of_path(i, n) + of_path(j, m));
    }
  }
  std::sort(values.begin(), values.end());
  return values;
}

void expect_lowest(const Spectrum& s, const std::vector<double>& truth, double scale) {
  for (Index k = 0; k < s.values.size(); ++k) {
    EXPECT_NEAR(s.values[k], scale * truth[static_cast<std::size_t>(k)], 1e-10 * scale) << k;
  }
}

TEST(Inertia, CountsTheEigenvaluesBelowAShift) {
  const Index n = 40;
  const SparseMatrix L = grid_laplacian(n, n);
  const std::vector<double> truth = grid_eigenvalues(n, n);
  for (const double tau : {0.05, 0.7, 3.3, 7.95}) {
    const auto below = std::count_if(truth.begin(), truth.end(), [&](double v) { return v < tau; });
    const std::optional<Index> count = negative_eigenvalues(L - tau * identity(n * n));
    ASSERT_TRUE(count) << tau;
    EXPECT_EQ(*count, below) << tau;
  }
}

TEST(Inertia, OfASingularMatrixIsNotTold) {
  EXPECT_FALSE(negative_eigenvalues(grid_laplacian(30, 30)));
}

TEST(Spectrum, OfAGridIsTheProductsOfPaths) {
  const Spectrum s = lowest_spectrum(grid_laplacian(31, 23),
                                     Eigen::VectorXd::Constant(31 * 23, 0.01), {.count = 20});
  expect_lowest(s, grid_eigenvalues(31, 23), 100.);
}

TEST(Spectrum, HasEveryCopyOfMultipleEigenvalues) {
  // Five equal squares: eigenvalues of multiplicity 5 and 10, of which one vector finds one each.
  const Index n = 21;
  const Spectrum s =
      lowest_spectrum(grid_laplacian(n, n, 5), Eigen::VectorXd::Ones(5 * n * n), {.count = 33});
  expect_lowest(s, grid_eigenvalues(n, n, 5), 1.);
}

TEST(Spectrum, FindsCopiesThatTheFirstRunLost) {
  const Spectrum s =
      lowest_spectrum(grid_laplacian(5, 5, 60), Eigen::VectorXd::Ones(60 * 25), {.count = 61});
  EXPECT_GT(s.copies_recovered, 0);  // else this is not the test that it wants to be
  expect_lowest(s, grid_eigenvalues(5, 5, 60), 1.);
}

TEST(Spectrum, AgreesWithDenseAlgebraWhereMassesDiffer) {
  const SparseMatrix A = grid_laplacian(19, 23);
  const Eigen::VectorXd mass = scrambled(19 * 23, 3).array().exp();
  const Spectrum s = lowest_spectrum(A, mass, {.count = 12});
  ASSERT_GT(s.rounds, 0);  // not dense itself
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> dense(
      Eigen::MatrixXd(A), Eigen::MatrixXd(mass.asDiagonal()));
  EXPECT_LT((s.values - dense.eigenvalues().head(12)).norm(), 1e-10);
}

TEST(Spectrum, VectorsAreOrthonormalEigenvectors) {
  for (const Index n : {9, 30}) {  // dense and not
    const SparseMatrix A = grid_laplacian(n, n);
    const Eigen::VectorXd mass = scrambled(n * n, 5).array() + 1.5;
    const Spectrum s = lowest_spectrum(A, mass, {.count = 15});
    const Eigen::MatrixXd gram = s.vectors.transpose() * mass.asDiagonal() * s.vectors;
    EXPECT_LT((gram - Eigen::MatrixXd::Identity(15, 15)).norm(), 1e-9);
    const Eigen::MatrixXd lhs = A * s.vectors;
    const Eigen::MatrixXd rhs = mass.asDiagonal() * s.vectors * s.values.asDiagonal();
    EXPECT_LT((lhs - rhs).norm(), 1e-8);
  }
}

TEST(Spectrum, DoesNotDependOnTheScale) {
  const SparseMatrix A = grid_laplacian(25, 20);
  const Eigen::VectorXd mass = Eigen::VectorXd::Ones(500);
  const Spectrum s = lowest_spectrum(A, mass, {.count = 8});
  for (const double scale : {0x1p-80, 0x1p80}) {
    const Spectrum t = lowest_spectrum(A, scale * mass, {.count = 8});
    EXPECT_LT((t.values * scale - s.values).norm(), 1e-11);
  }
}

TEST(Spectrum, RefusesWhatHasNone) {
  const SparseMatrix A = grid_laplacian(20, 20);
  const Eigen::VectorXd mass = Eigen::VectorXd::Ones(400);
  EXPECT_THROW(lowest_spectrum(A, mass, {.count = 0}), UsageError);
  EXPECT_THROW(lowest_spectrum(A, mass, {.count = 401}), UsageError);
  EXPECT_THROW(lowest_spectrum(A, mass.head(399), {}), UsageError);
  EXPECT_THROW(lowest_spectrum(A, mass, {.tolerance = 0}), UsageError);
  Eigen::VectorXd unused = mass;
  unused[7] = 0;
  EXPECT_THROW(lowest_spectrum(A, unused, {}), InputError);
  EXPECT_THROW(lowest_spectrum(SparseMatrix(-1. * A), mass, {}), SolverError);
}

}  // namespace
}  // namespace dsc
