// What takes long after everything is built tells its progress and is cancelled, too.
#include "libdsc/algorithms/diffusion.h"
#include "libdsc/algorithms/geodesic.h"
#include "libdsc/algorithms/laplace_beltrami.h"
#include "libdsc/algorithms/poisson.h"
#include "tests/algorithms/meshes.h"

#include <gtest/gtest.h>

namespace dsc {
namespace {

/// Counts the stages `solve`, and asks to stop in the first where it is to.
class SolveMonitor : public Monitor {
 public:
  explicit SolveMonitor(bool stop) : stop_(stop) {}
  void begin(std::string_view stage, Index) override {
    if (stage != "solve") return;
    ++solves;
    if (stop_) cancel();
  }
  int solves = 0;

 private:
  bool stop_;
};

/// `solve` does so under the context that it is given, and was built under another.
template <class Solve>
void expect_told_and_stopped(const Solve& solve) {
  SolveMonitor seen(false), stopped(true);
  EXPECT_NO_THROW(solve(Context{1, &seen}));
  EXPECT_GT(seen.solves, 0);
  EXPECT_THROW(solve(Context{1, &stopped}), Cancelled);
}

TEST(Cancelled, InSolvesByMultigrid) {
  const testing::Mesh mesh = testing::cube_sphere(12);
  const SolverOptions multigrid{.method = SolverMethod::multigrid};
  const Eigen::VectorXd x = mesh.positions.row(0);
  const std::vector<VertexId> first{0};

  const PoissonOptions poisson{.calculus = {}, .solver = multigrid, .factory = {}};
  const PoissonProblem free(mesh.flat(), {}, poisson), fixed(mesh.flat(), first, poisson);
  Eigen::VectorXd b = free.mass().cwiseProduct(x);
  b.array() -= b.mean();
  expect_told_and_stopped([&](const Context& context) { (void)free.solve(b, {}, context); });
  expect_told_and_stopped([&](const Context& context) { (void)fixed.solve(b, x, context); });
  expect_told_and_stopped([&](const Context& context) {
    (void)solve_poisson(mesh.flat(), b, {}, {}, poisson, context);
  });

  const HeatDiffusion heat(mesh.flat(), 0.1, {.calculus = {}, .solver = multigrid, .factory = {}});
  expect_told_and_stopped([&](const Context& context) { (void)heat.step(x, context); });

  LaplaceBeltramiOptions diffused;
  diffused.time = 0.1;
  diffused.solver = multigrid;
  const LaplaceBeltrami laplacian(mesh.flat(), diffused);
  expect_told_and_stopped([&](const Context& context) { (void)laplacian(x, context); });

  GeodesicOptions options;
  options.poisson.method = SolverMethod::multigrid;
  const GeodesicSolver distances(mesh.flat(), options);
  expect_told_and_stopped(
      [&](const Context& context) { (void)distances.distance(first, context); });
}

}  // namespace
}  // namespace dsc
