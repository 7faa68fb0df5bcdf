#include "libdsc/algorithms/regularise.h"

#include "libdsc/algorithms/mean_curvature.h"
#include "libdsc/base/error.h"
#include "libdsc/normals/surface_normals.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/shapes.h"
#include "tests/support/random_volume.h"
#include "tests/support/spheres.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <map>
#include <set>

namespace dsc {
namespace {

/// The energy of regularise.h as it is written there, by the plainest means.
double energy(const FlatMesh& mesh, const Eigen::Matrix3Xd& q, const RegulariseOptions& options) {
  double near = 0, aligned = 0, even = 0;
  for (Index v = 0; v < mesh.vertices(); ++v) near += (mesh.positions[v] - q.col(v)).squaredNorm();
  std::map<std::pair<VertexId, VertexId>, int> faces_of_edge;
  for (Index f = 0; f < mesh.faces(); ++f) {
    const auto ids = mesh.face(f);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const VertexId a = ids[i], b = ids[(i + 1) % ids.size()];
      aligned += std::pow((q.col(b) - q.col(a)).dot(mesh.normals[f]), 2);
      ++faces_of_edge[std::minmax(a, b)];
    }
  }
  std::map<VertexId, std::set<VertexId>> neighbours, along_boundary;
  for (const auto& [edge, faces] : faces_of_edge) {
    neighbours[edge.first].insert(edge.second);
    neighbours[edge.second].insert(edge.first);
    if (faces > 1) continue;
    along_boundary[edge.first].insert(edge.second);
    along_boundary[edge.second].insert(edge.first);
  }
  for (const auto& [v, others] : neighbours) {
    const auto& around = along_boundary.count(v) > 0 ? along_boundary[v] : others;
    Vec3 mean = Vec3::Zero();
    for (const VertexId w : around) mean += q.col(w) / static_cast<double>(around.size());
    even += (q.col(v) - mean).squaredNorm();
  }
  return options.alpha * near + options.beta * aligned + options.gamma * even;
}

/// No direction leads down from `q`, and every step leads up: the minimum.
void expect_minimum(const FlatMesh& mesh, const Eigen::Matrix3Xd& q,
                    const RegulariseOptions& options) {
  const double least = energy(mesh, q, options);
  EXPECT_LT(least, energy(mesh, mesh.positions.matrix(), options));
  const double h = mesh.spacing.maxCoeff();
  srand(4);
  for (int i = 0; i < 12; ++i) {
    Eigen::Matrix3Xd step = Eigen::Matrix3Xd::Zero(3, q.cols());
    if (i < 6) {
      step.setRandom();
    } else {
      step.col(rand() % q.cols()).setRandom();
    }
    step *= 0.1 * h;
    const double up = energy(mesh, q + step, options), down = energy(mesh, q - step, options);
    EXPECT_GT(up, least);
    EXPECT_GT(down, least);
    // The derivative along the step, against the curvature along it.
    EXPECT_LT(std::abs(up - down), 1e-3 * (up + down - 2 * least));
  }
}

RegulariseOptions precise() {
  RegulariseOptions options;
  options.accuracy = 1e-7;
  return options;
}

TEST(Regularise, FindsTheMinimumOfTheEnergy) {
  const DigitalSurface surface = testing::sphere(0.2);
  RegulariseOptions options = precise();
  expect_minimum(surface.flat(), regularise_positions(surface.flat(), options).positions, options);
  options.alpha = 0.3;
  options.beta = 0.2;
  options.gamma = 1.5;
  expect_minimum(surface.flat(), regularise_positions(surface.flat(), options).positions, options);
}

TEST(Regularise, FindsItOnPinchedSurfacesWithBoundaryToo) {
  const BinaryVolume volume = testing::random_volume({9, 8, 7}, 0.5, 5);
  ExtractOptions extract;
  extract.border = Border::open;
  DigitalSurface surface = extract_surface(volume, extract);
  EXPECT_GT(surface.counts().nonmanifold_edges, 0);
  EXPECT_GT(surface.counts().boundary_edges, 0);
  integral_invariant_normals(surface, volume, {.radius = 3});
  const RegularisedPositions result = regularise_positions(surface.flat(), precise());
  EXPECT_EQ(result.positions.cols(), surface.vertex_count());
  expect_minimum(surface.flat(), result.positions, precise());
}

TEST(Regularise, MovesAndScalesWithTheSurface) {
  const DigitalSurface surface = testing::sphere(0.2);
  FlatMesh mesh = surface.flat();
  const Eigen::Matrix3Xd reference = regularise_positions(mesh, precise()).positions;
  for (const double scale : {1., 1e-3, 40.}) {
    const Eigen::Matrix3Xd positions =
        (scale * mesh.positions.matrix()).colwise() + Vec3(100, -20, 3);
    FlatMesh moved = mesh;
    moved.positions = {positions.data(), positions.cols()};
    const Eigen::Matrix3Xd result = regularise_positions(moved, precise()).positions;
    const Eigen::Matrix3Xd expected = (scale * reference).colwise() + Vec3(100, -20, 3);
    EXPECT_LT((result - expected).cwiseAbs().maxCoeff(), 1e-6 * scale + 1e-12) << scale;
  }
}

TEST(Regularise, BringsTheSphereThirtyTimesNearer) {
  for (const double h : {0.1, 0.05}) {
    const DigitalSurface surface = testing::sphere(h);
    const RegularisedPositions result = regularise_positions(surface.flat());
    const auto deviation = [](const Eigen::Matrix3Xd& p) {
      return std::sqrt((p.colwise().norm().array() - 1).square().mean());
    };
    EXPECT_GT(deviation(surface.positions().matrix()), 0.3 * h);
    EXPECT_LT(deviation(result.positions), 0.03 * h);
    EXPECT_GT(result.mean_displacement, 0.2 * h);
    EXPECT_LT(result.largest_displacement, 1.5 * h);
  }
}

/// The calculus on the regularised mesh itself, whose faces now stand across the normals.
TEST(Regularise, GivesTheSphereItsMeanCurvature) {
  double error = 1;
  for (const double h : {0.1, 0.05, 0.025}) {
    const DigitalSurface surface = testing::sphere(h);
    const Eigen::Matrix3Xd smooth = regularise_positions(surface.flat()).positions;
    FlatMesh mesh = surface.flat(false);
    mesh.positions = {smooth.data(), smooth.cols()};
    mesh.surfels = {};
    LaplaceBeltramiOptions options;
    EXPECT_LT((mean_curvature(mesh, mesh.positions, options).mean.array() - 1).abs().maxCoeff(),
              0.5);
    options.time = 0.035 * h;
    const MeanCurvature diffused = mean_curvature(mesh, mesh.positions, options);
    const double here = (diffused.mean.array() - 1).abs().mean();
    EXPECT_LT(here, 0.8 * error) << h;
    error = here;
  }
  EXPECT_LT(error, 0.015);
}

TEST(Regularise, FlattensAPlaneAndKeepsItsBoundary) {
  const Plane plane(Vec3(1, 2, 4), 0.1, 6);
  ExtractOptions extract;
  extract.border = Border::open;
  DigitalSurface surface = extract_surface(digitize(plane, Vec3(0.1, 0.1, 0.1)), extract);
  analytic_normals(surface, plane);
  const RegularisedPositions result = regularise_positions(surface.flat());
  const auto distance = [&](const Eigen::Matrix3Xd& p) -> Eigen::VectorXd {
    return (plane.normal().transpose() * p).array() - plane.offset();
  };
  const Eigen::VectorXd smooth = distance(result.positions);
  EXPECT_GT(distance(surface.positions().matrix()).cwiseAbs().maxCoeff(), 0.05);
  // The low frequencies of the staircase, which nearness (α) keeps, are a few percent of h.
  EXPECT_LT((smooth.array() - smooth.mean()).matrix().cwiseAbs().maxCoeff(), 0.01);
  const Vec3 size = surface.positions().matrix().rowwise().maxCoeff() -
                    surface.positions().matrix().rowwise().minCoeff();
  const Vec3 kept = result.positions.rowwise().maxCoeff() - result.positions.rowwise().minCoeff();
  EXPECT_LT((size - kept).head<2>().cwiseAbs().maxCoeff(), 0.3);
}

/// Three labels meet along a line; its vertices stay one, and straight.
TEST(Regularise, KeepsAJunctionInOnePiece) {
  Grid grid{{14, 14, 10}};
  LabelVolume volume(grid, 1);
  for (Index z = 0; z < 10; ++z) {
    for (Index y = 0; y < 14; ++y) {
      for (Index x = 0; x < 14; ++x) volume.set(x, y, z, y < 7 ? 1 : (x < 7 ? 2 : 3));
    }
  }
  ExtractOptions extract;
  extract.border = Border::open;
  DigitalSurface surface = extract_surface(volume, extract);
  integral_invariant_normals(surface, volume, {.radius = 3});
  EXPECT_EQ(surface.counts().junction_edges, 10);
  const RegularisedPositions result = regularise_positions(surface.flat(), precise());
  ASSERT_EQ(result.positions.cols(), surface.vertex_count());
  expect_minimum(surface.flat(), result.positions, precise());
  EXPECT_LT(result.largest_displacement, 1.);
}

TEST(Regularise, AVertexOfNoFaceStays) {
  DigitalSurface surface = testing::sphere(0.3);
  Eigen::Matrix3Xd positions(3, surface.vertex_count() + 1);
  positions << surface.positions().matrix(), Vec3(7, 8, 9);
  FlatMesh mesh = surface.flat();
  mesh.positions = {positions.data(), positions.cols()};
  const RegularisedPositions result = regularise_positions(mesh, precise());
  EXPECT_LT((result.positions.rightCols(1) - Vec3(7, 8, 9)).norm(), 1e-9);
}

TEST(Regularise, RefusesWhatHasNoMinimum) {
  const DigitalSurface surface = testing::sphere(0.3);
  EXPECT_THROW(regularise_positions(surface.flat(false)), UsageError);
  for (double RegulariseOptions::*member :
       {&RegulariseOptions::alpha, &RegulariseOptions::beta, &RegulariseOptions::gamma,
        &RegulariseOptions::accuracy}) {
    for (const double bad : {-1., std::nan("")}) {
      RegulariseOptions options;
      options.*member = bad;
      EXPECT_THROW(regularise_positions(surface.flat(), options), UsageError);
    }
  }
}

TEST(Regularise, HasTheSameBitsForAnyThreadCount) {
  const DigitalSurface surface = testing::sphere(0.04);
  Context context;
  context.threads = 1;
  const RegularisedPositions one = regularise_positions(surface.flat(), {}, context);
  context.threads = 5;
  const RegularisedPositions many = regularise_positions(surface.flat(), {}, context);
  EXPECT_EQ(one.positions, many.positions);
  EXPECT_EQ(one.iterations, many.iterations);
}

}  // namespace
}  // namespace dsc
