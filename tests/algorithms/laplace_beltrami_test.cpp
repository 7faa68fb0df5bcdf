// The Laplacian of a function and the mean curvature, against analytic truth.
#include "libdsc/algorithms/laplace_beltrami.h"

#include "libdsc/algorithms/mean_curvature.h"
#include "libdsc/base/error.h"
#include "libdsc/normals/radius.h"
#include "libdsc/normals/surface_normals.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/closest_point.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/implicit_curvature.h"
#include "libdsc/voxels/shape_spec.h"
#include "tests/algorithms/meshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dsc {
namespace {

/// A digitised shape with integral invariant normals, its vertices projected, and H there.
struct Scene {
  std::unique_ptr<ImplicitShape> shape;
  DigitalSurface surface;
  ProjectedPoints projected;
  Eigen::VectorXd truth;

  Vec3View positions() const { return {projected.points.data(), projected.points.cols()}; }
};

Scene scene_of(const std::string& spec, double h) {
  Scene scene;
  scene.shape = make_shape(spec);
  const BinaryVolume volume = digitize(*scene.shape, Vec3(h, h, h));
  scene.surface = extract_surface(volume);
  integral_invariant_normals(scene.surface, volume, {.radius = shape_radius(h)});
  scene.projected = project_points(*scene.shape, scene.surface.positions());
  EXPECT_EQ(scene.projected.failures, 0);
  scene.truth.resize(scene.surface.vertex_count());
  for (Index v = 0; v < scene.truth.size(); ++v) {
    scene.truth[v] = implicit_curvature(*scene.shape, scene.projected.points.col(v)).value().mean;
  }
  return scene;
}

double rms(const Eigen::VectorXd& difference) {
  return std::sqrt(difference.squaredNorm() / static_cast<double>(difference.size()));
}

LaplaceBeltramiOptions options_of(Stabilization stabilization, double time) {
  LaplaceBeltramiOptions options;
  options.calculus.stabilization = stabilization;
  options.time = time;
  return options;
}

double curvature_error(const Scene& scene, Stabilization stabilization, double time) {
  return rms(
      mean_curvature(scene.surface.flat(), scene.positions(), options_of(stabilization, time))
          .mean -
      scene.truth);
}

/// The paper's figure 6: 0.059, 0.051 with the naive operators, 0.025, 0.003 with the projected
/// ones, each pointwise and diffused.
TEST(MeanCurvature, OnGoursatsSurfaceIsThatOfThePaper) {
  const Scene scene = scene_of("goursat", 0.25);
  const VertexNormals normals = vertex_normals(scene.surface.flat());
  EXPECT_EQ(normals.undefined, 0);
  const auto naive = [&](double time) {
    return rms(mean_curvature(scene.surface.flat(false), scene.positions(), normals,
                              options_of(Stabilization::de_goes, time))
                   .mean -
               scene.truth);
  };
  EXPECT_NEAR(naive(0), 0.059, 0.006);
  EXPECT_NEAR(naive(0.04), 0.051, 0.005);
  EXPECT_LT(curvature_error(scene, Stabilization::de_goes, 0), 0.025);
  EXPECT_LT(curvature_error(scene, Stabilization::de_goes, 0.04), 0.005);
  EXPECT_LT(curvature_error(scene, Stabilization::mercat, 0), 0.02);
  EXPECT_LT(curvature_error(scene, Stabilization::mercat, 0.04), 0.004);
}

TEST(MeanCurvature, ConvergesPointwiseWithoutStabilisationAndDiffusedWithIt) {
  double pointwise = 1, diffused = 1;
  for (const double h : {0.1, 0.05, 0.025}) {
    const Scene scene = scene_of("sphere", h);
    const double free = curvature_error(scene, Stabilization::mercat, 0);
    EXPECT_LT(free, 0.75 * pointwise) << h;
    pointwise = free;
    const double time = 0.035 * h;
    const double smooth = curvature_error(scene, Stabilization::de_goes, time);
    EXPECT_LT(smooth, 0.75 * diffused) << h;
    diffused = smooth;
    EXPECT_GT(curvature_error(scene, Stabilization::de_goes, 0), 0.1) << h;
    // The bias of λ = 0.25.
    const MeanCurvature biased = mean_curvature(scene.surface.flat(), scene.positions(),
                                                options_of(Stabilization::de_goes, 0));
    EXPECT_NEAR(biased.mean.mean(), 1.035, 0.015);
  }
  EXPECT_LT(pointwise, 0.015);
  EXPECT_LT(diffused, 0.02);
}

TEST(MeanCurvature, OfPointelsIsMeaningless) {
  const Scene scene = scene_of("sphere", 0.05);
  const MeanCurvature raw = mean_curvature(scene.surface.flat(), scene.surface.positions(), {});
  EXPECT_GT(rms(raw.mean - scene.truth), 3.);
}

TEST(MeanCurvature, OfAPlainMeshOfTheSphereIsOneAndOfAPlaneZero) {
  const testing::Mesh ball = testing::cube_sphere(40);
  const MeanCurvature round = mean_curvature(ball.flat(), ball.flat().positions, {});
  EXPECT_EQ(round.undefined_vertices, 0);
  EXPECT_LT((round.mean.array() - 1).abs().mean(), 0.02);
  const testing::Mesh flat = testing::grid(10, 12, 0.3);
  EXPECT_LT(mean_curvature(flat.flat(), flat.flat().positions, {}).mean.cwiseAbs().maxCoeff(),
            1e-12);
}

/// Δ x² = 2 − 6 x² on the unit sphere; the bounds of the diffused operator are published ones.
TEST(LaplaceBeltrami, DiffusedConvergesOnTheSphere) {
  const std::vector<std::pair<double, double>> bounds{{0.1, 0.074}, {0.05, 0.050}, {0.025, 0.026}};
  for (const auto& [h, bound] : bounds) {
    const Scene scene = scene_of("sphere", h);
    const Eigen::VectorXd x = scene.projected.points.row(0).transpose();
    const Eigen::VectorXd truth = 2 - 6 * x.array().square();
    const LaplaceBeltrami op(scene.surface.flat(), options_of(Stabilization::de_goes, 0.035 * h));
    const Solution diffused = op(x.array().square());
    EXPECT_LT(diffused.relative_residual, 1e-9);
    EXPECT_LT((diffused.x - truth).cwiseAbs().mean(), 1.25 * bound) << h;
  }
}

TEST(LaplaceBeltrami, PointwiseIsTheQuotientOfLAndM0AndSumsToZero) {
  const Scene scene = scene_of("torus", 0.1);
  const FlatMesh mesh = scene.surface.flat();
  const LaplaceBeltrami op(mesh);
  const Eigen::VectorXd f = scene.projected.points.row(2).transpose().array().cube();
  const LaplaceSystem system = assemble_laplacian(mesh);
  const Eigen::VectorXd laplacian = op.pointwise(f);
  EXPECT_EQ(laplacian, (system.L * f).cwiseQuotient(system.mass));
  EXPECT_NEAR(system.mass.dot(laplacian) / system.mass.dot(laplacian.cwiseAbs()), 0, 1e-12);
  EXPECT_EQ(op(f).x, laplacian);  // no time: pointwise
}

TEST(LaplaceBeltrami, RefusesBadInput) {
  const testing::Mesh mesh = testing::grid(2, 2);
  EXPECT_THROW(LaplaceBeltrami(mesh.flat(), options_of(Stabilization::de_goes, -1)), UsageError);
  const LaplaceBeltrami op(mesh.flat());
  EXPECT_THROW(op.pointwise(Eigen::VectorXd::Zero(4)), UsageError);
  EXPECT_THROW(op.pointwise(Eigen::VectorXd::Constant(9, std::nan(""))), InputError);
  EXPECT_THROW(mean_curvature(mesh.flat(), {mesh.positions.data(), 4}, {}), UsageError);
}

}  // namespace
}  // namespace dsc
