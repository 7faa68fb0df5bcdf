#include "libdsc/solve/dirichlet.h"

#include "libdsc/base/error.h"
#include "tests/solve/grid_systems.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <vector>

namespace dsc {
namespace {

using testing::grid_laplacian;
using testing::scrambled;

Components halves(Index n) {  // two components of n vertices each
  Components c;
  c.of_vertex.assign(static_cast<std::size_t>(2 * n), 0);
  for (Index i = n; i < 2 * n; ++i) c.of_vertex[static_cast<std::size_t>(i)] = 1;
  c.lowest = {0, static_cast<VertexId>(n)};
  return c;
}

TEST(Dirichlet, AgreesWithADenseSolveOfTheWholeSystem) {
  const SparseMatrix A = grid_laplacian(7, 8);
  const Eigen::VectorXd b = scrambled(56, 3);
  const Eigen::VectorXd values = scrambled(56, 4);
  const std::vector<VertexId> fixed{0, 9, 55, 20, 9};
  // Rows of fixed vertices replaced by x = value: unsymmetric, but a plain dense system.
  Eigen::MatrixXd dense(A);
  Eigen::VectorXd rhs = b;
  for (const VertexId v : fixed) {
    dense.row(v).setZero();
    dense(v, v) = 1;
    rhs[v] = values[v];
  }
  const Eigen::VectorXd expected = dense.fullPivLu().solve(rhs);
  const Solution s = DirichletSolver(A, fixed).solve(b, values);
  EXPECT_LT((s.x - expected).norm(), 1e-11 * expected.norm());
  for (const VertexId v : fixed) EXPECT_EQ(s.x[v], values[v]);
}

TEST(Dirichlet, LinearFunctionsAreHarmonicOnAGrid) {
  const Index n = 30, m = 40;
  Eigen::VectorXd linear(n * m);
  std::vector<VertexId> rim;
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < m; ++j) {
      linear[i * m + j] = 2. * static_cast<double>(i) - 3. * static_cast<double>(j) + 1;
      if (i == 0 || j == 0 || i == n - 1 || j == m - 1)
        rim.push_back(static_cast<VertexId>(i * m + j));
    }
  }
  Eigen::VectorXd values = Eigen::VectorXd::Zero(n * m);
  for (const VertexId v : rim) values[v] = linear[v];
  const DirichletSolver solver(grid_laplacian(n, m), rim);
  EXPECT_EQ(solver.free_unknowns(), (n - 2) * (m - 2));
  EXPECT_LT((solver.solve(Eigen::VectorXd::Zero(n * m), values).x - linear).cwiseAbs().maxCoeff(),
            1e-10);
}

TEST(Dirichlet, EverythingFixedReturnsTheValues) {
  const std::vector<VertexId> all{0, 1, 2, 3};
  const Eigen::VectorXd values = scrambled(4);
  EXPECT_EQ(DirichletSolver(grid_laplacian(2, 2), all).solve(scrambled(4, 9), values).x, values);
}

TEST(Dirichlet, AComponentWithoutAFixedVertexIsRefused) {
  const std::vector<VertexId> first_only{0};
  EXPECT_THROW(DirichletSolver(grid_laplacian(4, 4, 2), first_only), SolverError);
  EXPECT_THROW(DirichletSolver(grid_laplacian(4, 4), {}), SolverError);
}

TEST(Dirichlet, VerticesOutOfRangeAreRefused) {
  const std::vector<VertexId> past{16}, negative{-1};
  EXPECT_THROW(DirichletSolver(grid_laplacian(4, 4), past), UsageError);
  EXPECT_THROW(DirichletSolver(grid_laplacian(4, 4), negative), UsageError);
}

TEST(Neumann, RecoversAFunctionUpToAConstantOnEachComponent) {
  const SparseMatrix A = grid_laplacian(20, 30, 2);
  Eigen::VectorXd truth = scrambled(1200);
  for (const Index c : {0, 1}) {
    auto part = truth.segment(600 * c, 600);
    part.array() -= part.mean();
  }
  const Solution s = NeumannSolver(A, halves(600)).solve(A * truth);
  EXPECT_LT((s.x - truth).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Neumann, TheWeightedMeanVanishesOnEachComponent) {
  const SparseMatrix A = grid_laplacian(20, 30, 2);
  const Eigen::VectorXd weights = scrambled(1200, 5).array() + 2;
  const Solution s = NeumannSolver(A, halves(600)).solve(A * scrambled(1200), weights);
  for (const Index c : {0, 1}) {
    EXPECT_NEAR(s.x.segment(600 * c, 600).dot(weights.segment(600 * c, 600)), 0, 1e-9);
  }
}

TEST(Neumann, ValuesAndWeightsOfAnySizeHaveAMean) {
  const SparseMatrix A = grid_laplacian(20, 30, 2);
  const NeumannSolver solver(A, halves(600));
  const Eigen::VectorXd b = A * scrambled(1200), weights = scrambled(1200, 5).array() + 2;
  const Eigen::VectorXd x = solver.solve(b, weights).x;
  for (const double scale : {0x1p-700, 0x1p700}) {  // powers of two, which round nothing
    EXPECT_TRUE(solver.solve(scale * b, scale * weights).x == scale * x) << scale;
  }
}

TEST(Neumann, AnIncompatibleRightHandSideIsRefused) {
  const NeumannSolver solver(grid_laplacian(4, 4, 2), halves(16));
  Eigen::VectorXd b = Eigen::VectorXd::Zero(32);
  b[0] = 1;
  b[20] = -1;  // the whole sum vanishes, those of the components do not
  EXPECT_THROW(solver.solve(b), InputError);
}

TEST(Components, AreNumberedByTheirLowestVertex) {
  // Two quads that share a vertex only, a quad apart from them, and a vertex that no face uses.
  const std::vector<VertexId> corners{3, 4, 5, 6, 6, 7, 8, 9, 0, 12, 2, 11};
  const Eigen::Matrix3Xd positions = Eigen::Matrix3Xd::Zero(3, 13);
  FlatMesh mesh;
  mesh.positions = {positions.data(), 13};
  mesh.corners = corners;
  const Components c = connected_components(mesh);
  EXPECT_EQ(c.lowest, (std::vector<VertexId>{0, 1, 3, 10}));
  EXPECT_EQ(c.of_vertex, (std::vector<VertexId>{0, 1, 0, 2, 2, 2, 2, 2, 2, 2, 3, 0, 0}));
}

TEST(Components, AMissingVertexIsRefused) {
  const std::vector<VertexId> corners{0, 1, 2, 4};
  const Eigen::Matrix3Xd positions = Eigen::Matrix3Xd::Zero(3, 4);
  FlatMesh mesh;
  mesh.positions = {positions.data(), 4};
  mesh.corners = corners;
  EXPECT_THROW(connected_components(mesh), InputError);
}

}  // namespace
}  // namespace dsc
