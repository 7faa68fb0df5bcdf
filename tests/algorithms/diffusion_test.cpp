#include "libdsc/algorithms/diffusion.h"

#include "libdsc/algorithms/poisson.h"
#include "libdsc/base/error.h"
#include "libdsc/calculus/assembly.h"
#include "tests/algorithms/meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace dsc {
namespace {

using testing::cube_sphere;
using testing::grid;
using testing::join;
using testing::Mesh;

TEST(Diffusion, ConservesHeatOnEachComponent) {
  const Mesh mesh = join(cube_sphere(12), grid(10, 7, 0.1), Vec3(5, 0, 0));
  const Index sphere = 6 * 12 * 12 + 2;
  Eigen::VectorXd u0 = Eigen::VectorXd::Zero(mesh.positions.cols());
  u0[5] = 1;
  u0[sphere + 3] = -2;
  const HeatDiffusion heat(mesh.flat(), 0.3);
  const Eigen::VectorXd u = heat.step(u0).x;
  const Eigen::VectorXd before = heat.mass().cwiseProduct(u0), after = heat.mass().cwiseProduct(u);
  EXPECT_NEAR(after.head(sphere).sum(), before.head(sphere).sum(), 1e-12);
  EXPECT_NEAR(after.tail(88).sum(), before.tail(88).sum(), 1e-12);
}

TEST(Diffusion, TendsToTheMeanOfEachComponent) {
  const Mesh mesh = join(cube_sphere(8), grid(6, 5), Vec3(5, 0, 0));
  const Index sphere = 6 * 8 * 8 + 2;
  const Eigen::VectorXd u0 = mesh.positions.row(0).transpose();
  for (const double t : {1e6, 1e8, 1e10}) {
    const HeatDiffusion heat(mesh.flat(), t);
    const Eigen::VectorXd u = heat.step(u0).x;
    const double mean =
        heat.mass().head(sphere).dot(u0.head(sphere)) / heat.mass().head(sphere).sum();
    EXPECT_LT((u.head(sphere).array() - mean).abs().maxCoeff(), 100 / t) << t;
    const double other = heat.mass().tail(42).dot(u0.tail(42)) / heat.mass().tail(42).sum();
    EXPECT_LT((u.tail(42).array() - other).abs().maxCoeff(), 100 / t) << t;
  }
  EXPECT_THROW(HeatDiffusion(mesh.flat(), 1e18), UsageError);
}

TEST(Diffusion, KeepsConstantsAndVerticesWithoutFaces) {
  Mesh mesh = cube_sphere(6);
  mesh.positions.conservativeResize(3, mesh.positions.cols() + 1);
  mesh.positions.rightCols(1).setZero();
  Eigen::VectorXd u0 = Eigen::VectorXd::Constant(mesh.positions.cols(), 3.5);
  u0.tail(1).setConstant(-1);
  EXPECT_LT((diffuse(mesh.flat(), u0, 0.7).x - u0).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Diffusion, CoordinatesOnTheSphereDecayAsTheirEigenvalueTells) {
  // x is an eigenfunction of the sphere for -2: one implicit step divides it by 1 + 2 t.
  double previous = 1;
  for (const Index n : {10, 20, 40}) {
    const Mesh mesh = cube_sphere(n);
    const Eigen::VectorXd x = mesh.positions.row(0).transpose();
    const double error = (diffuse(mesh.flat(), x, 0.5).x - x / 2).cwiseAbs().maxCoeff();
    EXPECT_LT(error, 0.4 * previous);  // second order would be 0.25
    previous = error;
  }
  EXPECT_LT(previous, 1e-3);
}

TEST(Diffusion, BadTimesAndValuesAreRefused) {
  const Mesh mesh = grid(3, 3);
  EXPECT_THROW(HeatDiffusion(mesh.flat(), 0), UsageError);
  EXPECT_THROW(HeatDiffusion(mesh.flat(), -1), UsageError);
  EXPECT_THROW(HeatDiffusion(mesh.flat(), std::numeric_limits<double>::quiet_NaN()), UsageError);
  const HeatDiffusion heat(mesh.flat(), 1);
  EXPECT_THROW(heat.step(Eigen::VectorXd::Zero(15)), UsageError);
  EXPECT_THROW(heat.step(Eigen::VectorXd::Constant(16, std::numeric_limits<double>::infinity())),
               SolverError);
}

TEST(Poisson, RecoversWhatTheLaplacianWasAppliedTo) {
  const Mesh mesh = join(cube_sphere(9), grid(6, 5), Vec3(5, 0, 0));
  const SparseMatrix L = assemble_laplacian(mesh.flat()).L;
  const Eigen::VectorXd truth =
      (mesh.positions.row(0).array() * 3 + mesh.positions.row(1).array().square()).transpose();
  const PoissonProblem problem(mesh.flat(), {});
  const Eigen::VectorXd phi = problem.solve(L * truth).x;
  const Eigen::VectorXd difference = phi - truth;
  const Index sphere = 6 * 9 * 9 + 2;
  for (const auto& part : {difference.head(sphere), difference.tail(42)}) {
    EXPECT_NEAR(part.maxCoeff(), part.minCoeff(), 1e-10);
  }
  EXPECT_NEAR(problem.mass().head(sphere).dot(phi.head(sphere)), 0, 1e-10);
  EXPECT_NEAR(problem.mass().tail(42).dot(phi.tail(42)), 0, 1e-10);
}

TEST(Poisson, ConvergesOnTheSphere) {
  // The Laplace-Beltrami operator of xy on the unit sphere is -6 xy.
  double previous = 1;
  for (const Index n : {10, 20, 40}) {
    const Mesh mesh = cube_sphere(n);
    const Eigen::VectorXd xy =
        mesh.positions.row(0).cwiseProduct(mesh.positions.row(1)).transpose();
    const PoissonProblem problem(mesh.flat(), {});
    Eigen::VectorXd b = -6 * problem.mass().cwiseProduct(xy);
    b.array() -= b.mean();  // the sum vanishes up to rounding by symmetry; make it exact
    const double error = (problem.solve(b).x - xy).cwiseAbs().maxCoeff();
    EXPECT_LT(error, 0.4 * previous);
    previous = error;
  }
  EXPECT_LT(previous, 1e-3);
}

TEST(Poisson, FixedValuesStayAndLinearFunctionsAreHarmonic) {
  const Mesh mesh = grid(12, 9, 0.5);
  std::vector<VertexId> rim;
  for (Index v = 0; v < mesh.positions.cols(); ++v) {
    const Index i = v / 10, j = v % 10;
    if (i == 0 || j == 0 || i == 12 || j == 9) rim.push_back(static_cast<VertexId>(v));
  }
  const Eigen::VectorXd linear = (2 * mesh.positions.row(0) - mesh.positions.row(1)).transpose();
  const Solution s = solve_poisson(mesh.flat(), Eigen::VectorXd::Zero(130), rim, linear);
  EXPECT_LT((s.x - linear).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Poisson, ARightHandSideThatDoesNotBalanceIsRefused) {
  const Mesh mesh = grid(4, 4);
  EXPECT_THROW(solve_poisson(mesh.flat(), Eigen::VectorXd::Ones(25)), InputError);
}

}  // namespace
}  // namespace dsc
