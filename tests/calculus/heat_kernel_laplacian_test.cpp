#include "libdsc/calculus/heat_kernel_laplacian.h"

#include "libdsc/base/error.h"
#include "libdsc/normals/surface_normals.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/closest_point.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace dsc {
namespace {

DigitalSurface digital_sphere(double h) {
  const Sphere sphere(1.);
  DigitalSurface surface = extract_surface(digitize(sphere, Vec3(h, h, h)));
  analytic_normals(surface, sphere);
  return surface;
}

Eigen::Matrix3Xd centres(const FlatMesh& mesh) {
  Eigen::Matrix3Xd result = Eigen::Matrix3Xd::Zero(3, mesh.faces());
  for (Index f = 0; f < mesh.faces(); ++f) {
    for (const VertexId v : mesh.face(f)) result.col(f) += 0.25 * mesh.positions[v];
  }
  return result;
}

TEST(HeatKernelLaplacian, IsTheSumOverAllPairs) {
  const DigitalSurface surface = digital_sphere(0.15);
  const FlatMesh mesh = surface.flat();
  const Eigen::Matrix3Xd p = centres(mesh);
  const Eigen::VectorXd f = p.row(0).array().sin().matrix().transpose();
  for (const double t : {0.3, 0.02, 1e-4}) {
    const HeatKernelLaplacian laplacian(mesh, t);
    const Eigen::VectorXd mu = laplacian.masses();
    const Eigen::VectorXd Lf = laplacian.apply(f);
    for (Index s = 0; s < mesh.faces(); s += 7) {
      double sum = 0;
      double size = 0;  // of the terms, for what is cut off and for rounding
      for (Index r = 0; r < mesh.faces(); ++r) {
        const double square = (p.col(r) - p.col(s)).squaredNorm();
        const double term = std::exp(-square / (4 * t)) * (f[r] - f[s]) * mu[r];
        if (square <= 50 * t) {
          sum += term;
          size += std::abs(term);
        }
      }
      const double factor = 1 / (4 * std::numbers::pi * t * t);
      EXPECT_NEAR(Lf[s], factor * sum, 1e-12 * factor * size + 1e-300);
    }
  }
}

TEST(HeatKernelLaplacian, MassesAreTheProjectedAreas) {
  const DigitalSurface surface = digital_sphere(0.1);
  const FlatMesh mesh = surface.flat();
  const Eigen::VectorXd mu = HeatKernelLaplacian(mesh, 0.01).masses();
  for (Index f = 0; f < mesh.faces(); ++f) {
    const Vec3 e = mesh.surfels[static_cast<std::size_t>(f)].normal();
    EXPECT_NEAR(mu[f], 0.01 * std::abs(e.dot(mesh.normals[f])), 1e-15);
  }
}

TEST(HeatKernelLaplacian, KillsConstantsAndKeepsTheMean) {
  const DigitalSurface surface = digital_sphere(0.1);
  const FlatMesh mesh = surface.flat();
  const HeatKernelLaplacian laplacian(mesh, 0.04);
  EXPECT_EQ(laplacian.apply(Eigen::VectorXd::Constant(mesh.faces(), 3.7)).cwiseAbs().maxCoeff(), 0);
  const Eigen::VectorXd f = centres(mesh).row(2).array().exp().matrix().transpose();
  const Eigen::VectorXd Lf = laplacian.apply(f);
  const Eigen::VectorXd mu = laplacian.masses();
  EXPECT_NEAR(mu.dot(Lf), 0, 1e-12 * mu.dot(Lf.cwiseAbs()));
  EXPECT_LT(f.dot(mu.cwiseProduct(Lf)), 0);  // negative semi-definite
}

TEST(HeatKernelLaplacian, ConvergesPointwiseOnTheSphere) {
  // x^2 on the unit sphere: 2 - 6 x^2. The convolution itself, on the smooth sphere, has the
  // eigenvalue -6 + 12 t there, so its mean error is 12 t <|x^2 - 1/3|> = 12 t 4 / (9 sqrt 3),
  // which falls like t; the voxels must not add much.
  const Sphere sphere(1.);
  for (const double h : {0.1, 0.05, 0.025}) {
    const DigitalSurface surface = digital_sphere(h);
    const FlatMesh mesh = surface.flat();
    const Eigen::Matrix3Xd p = centres(mesh).colwise().normalized();
    const Eigen::VectorXd f = p.row(0).array().square().matrix().transpose();
    const double t = 0.1 * std::pow(h, 0.4);
    const Eigen::VectorXd Lf = HeatKernelLaplacian(mesh, t).apply(f);
    const double error = (Lf.array() - (2. - 6. * f.array())).abs().mean();
    EXPECT_NEAR(error, 12 * t * 4 / (9 * std::sqrt(3.)), 0.15 * h) << h;
  }
}

TEST(HeatKernelLaplacian, HasTheSameBitsForAnyThreadCount) {
  const DigitalSurface surface = digital_sphere(0.08);
  const FlatMesh mesh = surface.flat();
  const HeatKernelLaplacian laplacian(mesh, 0.03);
  const Eigen::VectorXd f = centres(mesh).row(1).transpose();
  const Eigen::VectorXd one = laplacian.apply(f, {.threads = 1});
  for (const int threads : {2, 8}) EXPECT_EQ(laplacian.apply(f, {.threads = threads}), one);
}

TEST(HeatKernelLaplacian, RefusesWhatIsNoFunction) {
  const DigitalSurface surface = digital_sphere(0.3);
  const FlatMesh mesh = surface.flat();
  EXPECT_THROW(HeatKernelLaplacian(mesh, 0), UsageError);
  EXPECT_THROW(HeatKernelLaplacian(mesh, std::numeric_limits<double>::infinity()), UsageError);
  const HeatKernelLaplacian laplacian(mesh, 0.1);
  EXPECT_THROW(laplacian.apply(Eigen::VectorXd::Zero(3)), UsageError);
  Eigen::VectorXd f = Eigen::VectorXd::Zero(mesh.faces());
  f[5] = std::nan("");
  EXPECT_THROW(laplacian.apply(f), InputError);
}

}  // namespace
}  // namespace dsc
