#include "libdsc/calculus/global_operators.h"

#include "libdsc/base/error.h"
#include "libdsc/calculus/assembly.h"
#include "libdsc/calculus/face_operators.h"
#include "libdsc/calculus/field_operators.h"
#include "tests/calculus/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace dsc {
namespace {

using testing::OwnedMesh;

void expect_equal(const SparseMatrix& a, const SparseMatrix& b, const std::string& what) {
  ASSERT_EQ(a.rows(), b.rows()) << what;
  ASSERT_EQ(a.cols(), b.cols()) << what;
  EXPECT_LT((a - b).norm(), 1e-10 * b.norm()) << what;
}

void expect_canonical(const SparseMatrix& m) {
  ASSERT_TRUE(m.isCompressed());
  for (Index c = 0; c < m.cols(); ++c) {
    for (int k = m.outerIndexPtr()[c]; k + 1 < m.outerIndexPtr()[c + 1]; ++k) {
      ASSERT_LT(m.innerIndexPtr()[k], m.innerIndexPtr()[k + 1]);
    }
  }
}

TEST(GlobalOperators, BlocksAreTheFacesOperators) {
  for (const OwnedMesh& owned : testing::mixed_family()) {
    const FlatMesh mesh = owned.view();
    const SparseMatrix M1 = mass1_matrix(mesh), flat = flat_matrix(mesh),
                       sharp = sharp_matrix(mesh);
    Index entries = 0;
    for (Index f = 0; f < mesh.faces(); ++f) {
      const FaceOperators face = face_operators(mesh, f);
      const Index c = mesh.first_corner(f), n = face.corners();
      entries += n * n;
      const Eigen::MatrixXd m = M1.block(c, c, n, n), v = flat.block(c, 3 * f, n, 3),
                            u = sharp.block(3 * f, c, 3, n);
      EXPECT_LT((m - face.mass1()).norm(), 1e-10 * m.norm());
      EXPECT_LT((v - face.flat()).norm(), 1e-10 * v.norm());
      EXPECT_LT((u - face.sharp()).norm(), 1e-10 * u.norm());
    }
    EXPECT_EQ(M1.nonZeros(), entries);
    EXPECT_EQ(flat.nonZeros(), 3 * mesh.corner_count());
    EXPECT_EQ(sharp.nonZeros(), 3 * mesh.corner_count());
  }
}

TEST(GlobalOperators, MatricesComposeAsTheFacesOperatorsDo) {
  for (const OwnedMesh& owned : testing::mixed_family()) {
    const FlatMesh mesh = owned.view();
    const SparseMatrix D = difference_matrix(mesh), M1 = mass1_matrix(mesh),
                       Div = divergence_matrix(mesh), G = gradient_matrix(mesh),
                       U = sharp_matrix(mesh), V = flat_matrix(mesh);
    for (const SparseMatrix* m : {&D, &M1, &Div, &G, &U, &V}) expect_canonical(*m);
    expect_equal(Div, -SparseMatrix(SparseMatrix(D.transpose()) * M1), "Div = -Dt M1");
    expect_equal(laplacian_matrix(mesh), SparseMatrix(Div * D), "L = Div D");
    expect_equal(G, SparseMatrix(U * D), "G = U D");
    expect_equal(SparseMatrix(U * SparseMatrix(V * G)), G, "U V = I on tangent vectors");
    EXPECT_LT((D * Eigen::VectorXd::Ones(mesh.vertices())).norm(), 1e-15);
  }
}

TEST(GlobalOperators, ProductsAreTheFieldOperators) {
  for (const OwnedMesh& owned : testing::mixed_family()) {
    const FlatMesh mesh = owned.view();
    const Eigen::VectorXd phi = Eigen::VectorXd::Random(mesh.vertices());
    const Eigen::Matrix3Xd d = Eigen::Matrix3Xd::Random(3, mesh.faces());
    const Eigen::VectorXd gradient = gradient_matrix(mesh) * phi;
    EXPECT_LT((gradient - face_gradients(mesh, phi).reshaped()).norm(), 1e-10 * gradient.norm());
    const Eigen::VectorXd divergence = divergence_matrix(mesh) * (flat_matrix(mesh) * d.reshaped());
    EXPECT_LT((divergence - integrated_divergence(mesh, d)).norm(), 1e-10 * divergence.norm());
    const SparseMatrix M0 = mass0_matrix(mesh);
    const Eigen::VectorXd mass = M0.diagonal();
    EXPECT_EQ(M0.nonZeros(), mesh.vertices());
    EXPECT_LT((mass - assemble_laplacian(mesh).mass).norm(), 1e-12 * mass.norm());
  }
}

TEST(GlobalOperators, StabilizationsReachM1) {
  for (const auto stabilization : {Stabilization::mercat, Stabilization::corrected_elements,
                                   Stabilization::virtual_refinement}) {
    CalculusOptions options;
    options.stabilization = stabilization;
    const OwnedMesh owned = testing::digital_family()[2];
    const FlatMesh mesh = owned.view();
    expect_equal(laplacian_matrix(mesh, options),
                 SparseMatrix(divergence_matrix(mesh, options) * difference_matrix(mesh)),
                 "L = Div D");
  }
}

TEST(GlobalOperators, ThreadsDoNotChangeABit) {
  OwnedMesh owned = testing::digital_mesh(testing::ball(20), Vec3(1., 1.5, 0.5));
  testing::add_normals(owned, 0.9, 3);
  const FlatMesh mesh = owned.view();
  const Context one{1};
  for (const int threads : {2, 4, 8}) {
    const Context many{threads};
    const auto same = [](const SparseMatrix& a, const SparseMatrix& b) {
      return a.nonZeros() == b.nonZeros() && (a - b).norm() == 0.;
    };
    EXPECT_TRUE(same(mass0_matrix(mesh, {}, one), mass0_matrix(mesh, {}, many)));
    EXPECT_TRUE(same(mass1_matrix(mesh, {}, one), mass1_matrix(mesh, {}, many)));
    EXPECT_TRUE(same(gradient_matrix(mesh, {}, one), gradient_matrix(mesh, {}, many)));
    EXPECT_TRUE(same(divergence_matrix(mesh, {}, one), divergence_matrix(mesh, {}, many)));
  }
}

TEST(GlobalOperators, BadCornersAreRefused) {
  OwnedMesh owned = testing::polygon_soup(1);
  owned.corners[5] = 1000;
  EXPECT_THROW(difference_matrix(owned.view()), InputError);
  EXPECT_THROW(gradient_matrix(owned.view()), InputError);
}

}  // namespace
}  // namespace dsc
