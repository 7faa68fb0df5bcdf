// The same bits for any thread count, on meshes of several chunks of every parallel loop.
#include "libdsc/algorithms/diffusion.h"
#include "libdsc/algorithms/poisson.h"
#include "tests/algorithms/meshes.h"

#include <gtest/gtest.h>

namespace dsc {
namespace {

using testing::cube_sphere;
using testing::Mesh;

/// 38 402 vertices: the widest chunk of any loop has 16 384.
const Mesh& sphere() {
  static const Mesh mesh = cube_sphere(80);
  return mesh;
}

template <class Solve>
void expect_same_bits(const Solve& solve) {
  const Eigen::VectorXd one = solve(Context{1});
  ASSERT_GT(one.cwiseAbs().maxCoeff(), 0);
  for (const int threads : {2, 4, 8}) EXPECT_TRUE(one == solve(Context{threads})) << threads;
}

TEST(Threads, DoNotChangeTheBitsOfDiffusion) {
  const Eigen::VectorXd heat = sphere().positions.row(0).array().square().transpose();
  expect_same_bits([&](const Context& context) {
    return HeatDiffusion(sphere().flat(), 0.01, {}, context).step(heat, context).x;
  });
}

TEST(Threads, DoNotChangeTheBitsOfPoissonByEitherMethod) {
  const Eigen::VectorXd xy =
      sphere().positions.row(0).cwiseProduct(sphere().positions.row(1)).transpose();
  for (const SolverMethod method : {SolverMethod::ldlt, SolverMethod::multigrid}) {
    PoissonOptions options;
    options.solver.method = method;
    expect_same_bits([&](const Context& context) {
      const PoissonProblem problem(sphere().flat(), {}, options, context);
      Eigen::VectorXd b = problem.mass().cwiseProduct(xy);
      b.array() -= b.mean();
      return problem.solve(b, {}, context).x;
    });
  }
}

}  // namespace
}  // namespace dsc
