#include "libdsc/calculus/surfel_operators.h"

#include "libdsc/calculus/face_operators.h"
#include "tests/calculus/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace dsc {
namespace {

struct Sample {
  SurfelShape shape;
  FaceOperators::Corners X;
  Vec3 u;
};

/// Every direction with random spacings and normals, steep and inward ones among them.
std::vector<Sample> samples() {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0.2, 3.);
  std::vector<Sample> result;
  for (int trial = 0; trial < 600; ++trial) {
    const Vec3 spacing(uniform(random), uniform(random), uniform(random));
    const int d = trial % 6;
    const SurfelShape shape = surfel_shapes(spacing)[static_cast<std::size_t>(d)];
    FaceOperators::Corners X = FaceOperators::Corners::Zero(4, 3);
    X(1, shape.x) = X(2, shape.x) = spacing[shape.x];
    X(2, shape.y) = X(3, shape.y) = spacing[shape.y];
    result.push_back({shape, X, testing::random_unit(random)});
  }
  return result;
}

Eigen::Matrix4d matrix(const SurfelLaplacian& L, double lambda_f) {
  Eigen::Matrix4d m;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) m(i, j) = L.entry(i, j, lambda_f);
  return m;
}

constexpr double kMinCosine = 0.05;

TEST(SurfelOperators, FrameIsThatOfTheOutwardNormal) {
  for (const Sample& s : samples()) {
    const FaceOperators face(s.X);
    EXPECT_EQ(face.normal()[s.shape.z], s.shape.sign);
  }
}

TEST(SurfelOperators, LaplacianIsThatOfTheProjectedPolygon) {
  for (const Sample& s : samples()) {
    const SurfelOperators surfel(s.shape, s.u, kMinCosine);
    const FaceOperators face(s.X, s.u, 0.25, kMinCosine);
    const Eigen::MatrixXd expected = face.laplacian();
    EXPECT_EQ(surfel.clamped(), face.clamped());
    EXPECT_NEAR(surfel.area(), face.area(), 1e-13 * s.shape.area());
    EXPECT_LT((surfel.normal() - face.normal()).norm(), 1e-13);
    EXPECT_LT((matrix(surfel.laplacian(), 0.25) - expected).norm(), 1e-11 * expected.norm());
  }
}

TEST(SurfelOperators, GradientAndDivergenceAreThoseOfTheProjectedPolygon) {
  std::mt19937 random(5);
  for (const Sample& s : samples()) {
    const SurfelOperators surfel(s.shape, s.u, kMinCosine);
    const FaceOperators face(s.X, s.u, 0.25, kMinCosine);
    const Eigen::Vector4d phi = Eigen::Vector4d::Random();
    const Vec3 expected = face.gradient() * phi;
    EXPECT_LT((surfel.gradient(phi[0], phi[1], phi[2], phi[3]) - expected).norm(),
              1e-11 * (1. + face.gradient().norm()));
    const Vec3 d = testing::random_unit(random);
    const auto divergence = surfel.divergence(d);
    const Eigen::Vector4d reference = face.divergence() * face.flat() * d;
    EXPECT_LT((Eigen::Map<const Eigen::Vector4d>(divergence.data()) - reference).norm(), 1e-11);
  }
}

TEST(SurfelOperators, NaiveEmbeddingIsTheFaceItself) {
  for (const Sample& s : samples()) {
    const Eigen::MatrixXd expected = FaceOperators(s.X).laplacian();
    const Eigen::Matrix4d L = matrix(SurfelOperators(s.shape).laplacian(), 0.25);
    EXPECT_LT((L - expected).norm(), 1e-13 * expected.norm());
  }
}

TEST(SurfelOperators, StabilizationsDifferInTheTwistAlone) {
  const Eigen::Vector4d twist(1., -1., 1., -1.);
  for (const Sample& s : samples()) {
    const SurfelOperators surfel(s.shape, s.u, kMinCosine);
    const Vec3 u = surfel.normal();
    const double ux = u[s.shape.x], uy = u[s.shape.y], uz = s.shape.sign * u[s.shape.z];
    const double yx = s.shape.hy / s.shape.hx;
    const double full = (yx * (1. - uy * uy) + (1. - ux * ux) / yx) / uz;  // s of options.h
    const SurfelLaplacian L = surfel.laplacian();
    const auto twist_term = [&](Stabilization stabilization) {
      const double lambda_f = SurfelLambda({0.3, kMinCosine, stabilization})(L.s);
      const Eigen::Matrix4d m = matrix(L, lambda_f);
      return -(twist.dot(m * twist)) / 16.;
    };
    EXPECT_NEAR(twist_term(Stabilization::de_goes), 0.3, 1e-12 * full);
    EXPECT_NEAR(twist_term(Stabilization::mercat), 0., 1e-12 * full);
    EXPECT_NEAR(twist_term(Stabilization::corrected_elements), full / 12., 1e-12 * full);
    EXPECT_NEAR(twist_term(Stabilization::virtual_refinement), full / 8., 1e-12 * full);
  }
}

/// Bilinear elements on a flat rectangle, integrated here by 2 × 2 Gauss points.
TEST(SurfelOperators, CorrectedElementsAreBilinearElementsOnFlatSurfels) {
  const SurfelShape shape{0, 1, 2, 1., 0.7, 1.9};
  Eigen::Matrix4d stiffness = Eigen::Matrix4d::Zero();
  const double g = 0.5 / std::sqrt(3.);
  for (const double x : {0.5 - g, 0.5 + g}) {
    for (const double y : {0.5 - g, 0.5 + g}) {
      const Eigen::Vector4d dx = Eigen::Vector4d(y - 1., 1. - y, y, -y) / shape.hx;
      const Eigen::Vector4d dy = Eigen::Vector4d(x - 1., -x, x, 1. - x) / shape.hy;
      stiffness += 0.25 * shape.area() * (dx * dx.transpose() + dy * dy.transpose());
    }
  }
  const SurfelLaplacian L = SurfelOperators(shape).laplacian();
  const SurfelLambda lambda({0.25, 0.01, Stabilization::corrected_elements});
  EXPECT_LT((matrix(L, lambda(L.s)) + stiffness).norm(), 1e-13);
}

/// DESIGN: no off-diagonal entry is negative exactly where |ρ − 1/ρ|/4 <= λ <= (ρ + 1/ρ)/4.
TEST(SurfelOperators, MaximumPrincipleHoldsInItsIntervalOfLambdaOnly) {
  for (const double rho : {0.4, 0.8, 1., 1.7}) {
    const SurfelLaplacian L = SurfelOperators(SurfelShape{0, 1, 2, 1., 1., rho}).laplacian();
    const auto least = [&](double lambda_f) {
      const Eigen::Matrix4d m = matrix(L, lambda_f);
      return std::min({m(0, 1), m(0, 2), m(0, 3)});
    };
    const double low = std::abs(rho - 1. / rho) / 4.;
    const double high = (rho + 1. / rho) / 4.;
    EXPECT_GE(least(low + 1e-9), 0.);
    EXPECT_GE(least(high - 1e-9), 0.);
    EXPECT_LT(least(high + 1e-9), 0.);
    if (low > 0.) {
      EXPECT_LT(least(low - 1e-9), 0.);
    }
  }
}

}  // namespace
}  // namespace dsc
