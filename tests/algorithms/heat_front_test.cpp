#include "libdsc/algorithms/heat_front.h"

#include "libdsc/algorithms/diffusion.h"
#include "libdsc/algorithms/heat_directions.h"
#include "libdsc/algorithms/heat_levels.h"
#include "libdsc/calculus/assembly.h"
#include "libdsc/solve/ldlt_factor.h"
#include "tests/algorithms/meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace dsc {
namespace {

/// The largest difference of the logarithms of heat by the front and by one factorization of all.
double against_the_full_solve(const SparseMatrix& A, VertexId source, const FrontOptions& options,
                              HeatFront* report = nullptr) {
  WideVector full(A.rows());
  full.set(source, {1, 0});
  LdltFactor(A).solve_in_place(full);
  const HeatFront front = diffuse_front(A, {&source, 1}, {}, options);
  if (report != nullptr) *report = front;
  double worst = 0;
  for (Index v = 0; v < A.rows(); ++v) {
    if (!(full.mantissa(v) > 0 && front.w.mantissa(v) > 0)) return INFINITY;
    worst = std::max(worst, std::abs(full.log(v) - front.w.log(v)));
  }
  return worst;
}

/// I + K, K the graph Laplacian of weighted edges.
struct Graph {
  explicit Graph(Index vertices) : n(vertices) {
    for (int v = 0; v < n; ++v) entries.emplace_back(v, v, 1.);
  }
  void edge(int a, int b, double weight) {
    entries.emplace_back(a, a, weight);
    entries.emplace_back(b, b, weight);
    entries.emplace_back(a, b, -weight);
    entries.emplace_back(b, a, -weight);
  }
  SparseMatrix matrix() const {
    SparseMatrix A(n, n);
    A.setFromTriplets(entries.begin(), entries.end());
    return A;
  }
  Index n;
  std::vector<Eigen::Triplet<double>> entries;
};

TEST(HeatFront, EqualsTheFullSolveEntryByEntry) {
  const testing::Mesh sphere = testing::cube_sphere(40);
  const SparseMatrix A = heat_matrix(assemble_laplacian(sphere.flat()), std::pow(M_PI / 2 / 40, 2));
  // sqrt(t) times this is what distances may differ by.
  EXPECT_LT(against_the_full_solve(A, 901, {}), 2e-3);
  EXPECT_LT(against_the_full_solve(A, 901, {8, 12}), 1e-5);  // the overlap it is that does it
}

TEST(HeatFront, FindsHeatThatComesFromAheadOfTheFront) {
  // A path of 20 edges, and beside it a detour of 26 which couple so strongly that heat arrives by
  // them, against the order of the levels.
  constexpr int kPath = 20, kDetour = 26;
  Graph graph(kPath + kDetour);
  for (int v = 0; v < kPath; ++v) graph.edge(v, v + 1, 1.);
  graph.edge(0, kPath + 1, 1e2);
  for (int v = kPath + 1; v + 1 < kPath + kDetour; ++v) graph.edge(v, v + 1, 1e2);
  graph.edge(kPath + kDetour - 1, kPath, 1e2);
  HeatFront report;
  EXPECT_LT(against_the_full_solve(graph.matrix(), 0, {8, 8}, &report), 1e-2);
  EXPECT_GT(report.repairs, 0);
}

TEST(HeatDirections, AreThoseOfTheSizeOfHeat) {
  // Positive couplings can turn its sign in a whole sector.
  const testing::Mesh mesh = testing::grid(20, 20);
  WideVector w(mesh.positions.cols()), turned(mesh.positions.cols());
  for (Index v = 0; v < w.size(); ++v) {
    const double heat = std::exp(-mesh.positions.col(v).norm());
    w.set(v, {heat, 0});
    turned.set(v, {v % 21 < 7 ? -heat : heat, 0});
  }
  const HeatDirections plain = heat_directions(mesh.flat(), w, 1);
  const HeatDirections same = heat_directions(mesh.flat(), turned, 1);
  EXPECT_EQ(plain.d, same.d);
  EXPECT_EQ(plain.negative_faces, 0);
  EXPECT_EQ(same.negative_faces, 20 * 7);
}

TEST(HeatFront, NumbersVerticesByTheirHopsFromTheSources) {
  Graph graph(7);  // 0 - 1 - 2 - 3 and 4 - 3; 5 is held at 0, so that 6 is out of reach
  for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 6}}) {
    graph.edge(a, b, 1.);
  }
  const std::vector<VertexId> sources{0, 4, 4};
  const std::vector<char> fixed{0, 0, 0, 0, 0, 1, 0};
  const HeatLevels levels = heat_levels(graph.matrix(), sources, fixed);
  ASSERT_EQ(levels.count(), 3);
  EXPECT_EQ(levels.order, (std::vector<VertexId>{0, 4, 1, 3, 2}));
  EXPECT_EQ(levels.starts, (std::vector<Index>{0, 2, 4, 5}));
  EXPECT_EQ(levels.position(5), -1);
  EXPECT_EQ(levels.position(6), -1);
}

}  // namespace
}  // namespace dsc
