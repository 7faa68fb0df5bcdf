#include "libdsc/calculus/field_operators.h"

#include "libdsc/base/error.h"
#include "libdsc/calculus/assembly.h"
#include "libdsc/calculus/face_operators.h"
#include "tests/calculus/meshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dsc {
namespace {

using testing::OwnedMesh;

TEST(FieldOperators, GradientsAndDivergenceAreThoseOfTheFaces) {
  for (const OwnedMesh& owned : testing::mixed_family()) {
    const FlatMesh mesh = owned.view();
    const Eigen::VectorXd phi = Eigen::VectorXd::Random(mesh.vertices());
    const Eigen::Matrix3Xd d = Eigen::Matrix3Xd::Random(3, mesh.faces());
    const Eigen::Matrix3Xd gradients = face_gradients(mesh, phi);
    Eigen::VectorXd expected = Eigen::VectorXd::Zero(mesh.vertices());
    for (Index f = 0; f < mesh.faces(); ++f) {
      const FaceOperators face = face_operators(mesh, f);
      const auto ids = mesh.face(f);
      Eigen::VectorXd local(face.corners());
      for (std::size_t i = 0; i < ids.size(); ++i) local[static_cast<Index>(i)] = phi[ids[i]];
      const Vec3 gradient = face.gradient() * local;
      EXPECT_LT((gradients.col(f) - gradient).norm(), 1e-11 * (1. + face.gradient().norm()));
      local = face.divergence() * face.flat() * d.col(f);
      for (std::size_t i = 0; i < ids.size(); ++i) expected[ids[i]] += local[static_cast<Index>(i)];
    }
    EXPECT_LT((integrated_divergence(mesh, d) - expected).norm(), 1e-10 * expected.norm());
  }
}

TEST(FieldOperators, GreensFormulaHolds) {
  for (const OwnedMesh& owned : testing::mixed_family()) {
    const FlatMesh mesh = owned.view();
    const Eigen::VectorXd phi = Eigen::VectorXd::Random(mesh.vertices());
    const Eigen::Matrix3Xd d = Eigen::Matrix3Xd::Random(3, mesh.faces());
    const Eigen::Matrix3Xd gradients = face_gradients(mesh, phi);
    double sum = 0.;
    double scale = 0.;
    for (Index f = 0; f < mesh.faces(); ++f) {
      const double term = face_operators(mesh, f).area() * gradients.col(f).dot(d.col(f));
      sum += term;
      scale += std::abs(term);
    }
    EXPECT_NEAR(phi.dot(integrated_divergence(mesh, d)), -sum, 1e-11 * scale);
  }
}

/// Mercat's Laplacian has no second part, so it is the divergence of the gradient.
TEST(FieldOperators, DivergenceOfGradientIsTheLaplacianWithoutItsSecondPart) {
  CalculusOptions options;
  options.stabilization = Stabilization::mercat;
  for (const OwnedMesh& owned : testing::mixed_family()) {
    const FlatMesh mesh = owned.view();
    const Eigen::VectorXd phi = Eigen::VectorXd::Random(mesh.vertices());
    const Eigen::VectorXd expected = assemble_laplacian(mesh, options).L * phi;
    const Eigen::VectorXd result = integrated_divergence(mesh, face_gradients(mesh, phi));
    EXPECT_LT((result - expected).norm(), 1e-10 * expected.norm());
  }
}

TEST(FieldOperators, LinearFunctionsHaveTheirTangentSlope) {
  const Vec3 slope(1., -2., 0.5);
  for (const OwnedMesh& owned : testing::digital_family()) {
    OwnedMesh naive = owned;
    naive.normals.clear();
    const FlatMesh mesh = naive.view();
    const Eigen::VectorXd phi = mesh.positions.matrix().transpose() * slope;
    const Eigen::Matrix3Xd gradients = face_gradients(mesh, phi);
    for (Index f = 0; f < mesh.faces(); ++f) {
      const Vec3 e = owned.surfels[static_cast<std::size_t>(f)].normal();
      EXPECT_LT((gradients.col(f) - (slope - slope.dot(e) * e)).norm(), 1e-12);
    }
  }
}

TEST(FieldOperators, ThreadsDoNotChangeABit) {
  OwnedMesh big = testing::digital_mesh(testing::ball(24), Vec3(1., 1.5, 0.5));
  testing::add_normals(big, 0.9, 3);
  for (const OwnedMesh& owned : {big, big.as_polygons()}) {
    const FlatMesh mesh = owned.view();
    const Eigen::VectorXd phi = Eigen::VectorXd::Random(mesh.vertices());
    const Eigen::Matrix3Xd d = Eigen::Matrix3Xd::Random(3, mesh.faces());
    const Eigen::Matrix3Xd gradients = face_gradients(mesh, phi, {}, Context{1});
    const Eigen::VectorXd divergence = integrated_divergence(mesh, d, {}, Context{1});
    for (const int threads : {2, 4, 8}) {
      EXPECT_EQ(gradients, face_gradients(mesh, phi, {}, Context{threads}));
      EXPECT_EQ(divergence, integrated_divergence(mesh, d, {}, Context{threads}));
    }
  }
}

TEST(FieldOperators, WrongShapesAndValuesAreRefused) {
  const OwnedMesh owned = testing::digital_family()[0];
  const FlatMesh mesh = owned.view();
  EXPECT_THROW(face_gradients(mesh, Eigen::VectorXd::Zero(3)), UsageError);
  EXPECT_THROW(integrated_divergence(mesh, Eigen::Matrix3Xd::Zero(3, 3)), UsageError);
  Eigen::VectorXd phi = Eigen::VectorXd::Zero(mesh.vertices());
  phi[4] = std::nan("");
  EXPECT_THROW(face_gradients(mesh, phi), InputError);
  Eigen::Matrix3Xd d = Eigen::Matrix3Xd::Zero(3, mesh.faces());
  d(1, 6) = INFINITY;
  EXPECT_THROW(integrated_divergence(mesh, d), InputError);
}

}  // namespace
}  // namespace dsc
