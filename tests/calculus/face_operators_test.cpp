#include "libdsc/calculus/face_operators.h"

#include "libdsc/base/error.h"

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <cmath>
#include <random>
#include <vector>

namespace dsc {
namespace {

using Corners = FaceOperators::Corners;

/// Random polygons of 3 to 8 corners: planar and convex, planar and not, not planar; far from the
/// origin too; as they are and projected along a random normal.
std::vector<FaceOperators> polygons() {
  std::mt19937 random(3);
  std::normal_distribution<double> gauss;
  std::vector<FaceOperators> faces;
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 3 + trial % 6;
    Corners X(n, 3);
    for (int i = 0; i < n; ++i) {
      const double angle = 2. * M_PI * i / n;
      const double radius = trial % 2 == 0 ? 1. : 0.6 + 0.4 * gauss(random);
      const double lift = trial % 3 == 0 ? 0. : 0.5 * gauss(random);
      X.row(i) << radius * std::cos(angle), radius * std::sin(angle), lift;
    }
    const Vec3 axis = Vec3(gauss(random), gauss(random), gauss(random)).normalized();
    const Mat3 turn = Eigen::AngleAxisd(gauss(random), axis).toRotationMatrix();
    const Vec3 shift(gauss(random), gauss(random), 3. * gauss(random));
    X = (X * turn.transpose()).rowwise() + shift.transpose();
    faces.emplace_back(X);
    const Vec3 u = (turn.col(2) + 0.7 * axis).normalized();
    faces.emplace_back(X, u);
  }
  return faces;
}

/// Rounding of an operator of size 1 that is divided by the area once or twice.
double tolerance(const FaceOperators& f) {
  const double size = 1. + f.E().norm() / std::sqrt(f.area());
  return 1e-13 * size * size * size * size * (1. + f.centroid().norm());
}

Mat3 tangent_projection(const FaceOperators& f) {
  return Mat3::Identity() - f.normal() * f.normal().transpose();
}

TEST(FaceOperators, GradientOfConstantVanishes) {
  for (const auto& f : polygons()) {
    EXPECT_LT((f.gradient() * Eigen::VectorXd::Ones(f.corners())).norm(), tolerance(f));
  }
}

TEST(FaceOperators, GradientOfPositionIsTangentProjection) {
  for (const auto& f : polygons()) {
    EXPECT_LT((f.gradient() * f.X() - tangent_projection(f)).norm(), tolerance(f));
  }
}

TEST(FaceOperators, GradientOfLinearFunctionPointsUphill) {
  const Vec3 slope(0.3, -1.2, 0.7);
  for (const auto& f : polygons()) {
    const Eigen::VectorXd phi = f.X() * slope + 5. * Eigen::VectorXd::Ones(f.corners());
    const Vec3 gradient = f.gradient() * phi;
    EXPECT_LT((gradient - tangent_projection(f) * slope).norm(), 10. * tolerance(f));
    EXPECT_GE(gradient.dot(slope), -tolerance(f));
  }
}

TEST(FaceOperators, CoGradientIsTheGradientTurnedAndIntegrated) {
  for (const auto& f : polygons()) {
    const Mat3 t = tangent_projection(f);
    EXPECT_LT((t * f.co_gradient() - f.area() * f.bracket() * f.gradient()).norm(), tolerance(f));
  }
}

TEST(FaceOperators, SharpOfFlatIsTangentProjection) {
  for (const auto& f : polygons()) {
    EXPECT_LT((f.sharp() * f.flat() - tangent_projection(f)).norm(), tolerance(f));
  }
}

TEST(FaceOperators, GradientIsSharpOfDifference) {
  for (const auto& f : polygons()) {
    EXPECT_LT((f.gradient() - f.sharp() * f.D()).norm(), tolerance(f));
  }
}

TEST(FaceOperators, ProjectionKillsFlats) {
  for (const auto& f : polygons()) EXPECT_LT((f.projection() * f.flat()).norm(), tolerance(f));
}

TEST(FaceOperators, CurlOfDifferenceVanishes) {
  for (const auto& f : polygons()) EXPECT_EQ((f.curl() * f.D()).norm(), 0.);
}

TEST(FaceOperators, DivergenceOfFlatIsMinusGradientTransposed) {
  for (const auto& f : polygons()) {
    EXPECT_LT((f.divergence() * f.flat() + f.area() * f.gradient().transpose()).norm(),
              tolerance(f));
  }
}

TEST(FaceOperators, LaplacianIsSymmetricNegativeSemidefiniteWithConstantsAsKernel) {
  for (const auto& f : polygons()) {
    const Eigen::MatrixXd L = f.laplacian();
    const double eps = tolerance(f) * (1. + L.norm());
    EXPECT_LT((L - L.transpose()).norm(), eps);
    EXPECT_LT((L * Eigen::VectorXd::Ones(f.corners())).norm(), eps);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(L);
    const Eigen::VectorXd values = eigen.eigenvalues();
    EXPECT_LT(values[values.size() - 1], eps);
    // Nothing but the constants: λ > 0 sees what the gradient does not.
    EXPECT_LT(values[values.size() - 2], -1e-4);
  }
}

TEST(FaceOperators, MassesAreThoseOfTheProjectedArea) {
  for (const auto& f : polygons()) {
    EXPECT_NEAR(f.mass0().trace(), f.area(), 1e-12 * f.area());
    // |V w|² in M1 is the integral of |w|² for tangent w.
    const Vec3 w = tangent_projection(f) * Vec3(1., 2., -0.5);
    const Eigen::VectorXd form = f.flat() * w;
    EXPECT_NEAR(form.dot(f.mass1() * form), f.area() * w.squaredNorm(), 10. * tolerance(f));
  }
}

TEST(FaceOperators, ProjectionAlongTheEstimateMakesItTheNormal) {
  Corners X(4, 3);
  X << 0, 0, 0, 1, 0, 0, 1, 2, 0, 0, 2, 0;
  const Vec3 u = Vec3(1., 2., 2.) / 3.;
  const FaceOperators f(X, u);
  EXPECT_LT((f.normal() - u).norm(), 1e-14);
  EXPECT_NEAR(f.area(), 2. * 2. / 3., 1e-14);
  EXPECT_FALSE(f.clamped());
}

TEST(FaceOperators, SteepNormalsAreTiltedBackAndReported) {
  Corners X(3, 3);
  X << 0, 0, 0, 2, 0, 0, 0, 1, 0;
  for (const Vec3& u :
       {Vec3(1., 0., 0.), Vec3(0.6, 0., -0.8), Vec3(0.99998, 0.006, 0.).normalized().eval()}) {
    const FaceOperators f(X, u, 0.25, 0.1);
    EXPECT_TRUE(f.clamped());
    EXPECT_NEAR(f.normal().z(), 0.1, 1e-14);
    EXPECT_NEAR(f.area(), 0.1, 1e-14);
    const Vec3 across(u.x(), u.y(), 0.);
    EXPECT_NEAR(f.normal().dot(across.normalized()), std::sqrt(0.99), 1e-14);
  }
  const FaceOperators opposite(X, Vec3(0., 0., -1.));
  EXPECT_TRUE(opposite.clamped());
  EXPECT_NEAR(opposite.area(), 1., 1e-14);
}

TEST(FaceOperators, UnusableFacesAreRefused) {
  Corners line(3, 3);
  line << 0, 0, 0, 1, 1, 1, 3, 3, 3;
  EXPECT_THROW(FaceOperators{line}, InputError);
  EXPECT_THROW(FaceOperators{Corners::Zero(4, 3)}, InputError);
  EXPECT_THROW(FaceOperators{Corners::Random(2, 3)}, InputError);
  Corners nan(3, 3);
  nan << 0, 0, 0, 1, 0, 0, 0, std::nan(""), 0;
  EXPECT_THROW(FaceOperators{nan}, InputError);
  Corners good(3, 3);
  good << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  EXPECT_NO_THROW(FaceOperators{good});
  EXPECT_THROW(FaceOperators(good, Vec3(0., 0., 2.)), InputError);
  EXPECT_THROW(FaceOperators(good, Vec3(0., 0., std::nan(""))), InputError);
}

}  // namespace
}  // namespace dsc
