#include "libdsc/calculus/assembly.h"

#include "libdsc/base/error.h"
#include "libdsc/calculus/face_operators.h"
#include "libdsc/calculus/laplacian_pattern.h"
#include "tests/calculus/meshes.h"

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace dsc {
namespace {

using testing::OwnedMesh;

std::vector<OwnedMesh> family() {
  std::vector<OwnedMesh> meshes = testing::digital_family();
  for (std::size_t i = 0; i < 3; ++i) meshes.push_back(meshes[i].as_polygons());
  meshes.push_back(testing::polygon_soup(1));
  return meshes;
}

/// The sum of the reference's local matrices, by vertex id.
Eigen::MatrixXd dense_laplacian(const FlatMesh& mesh, Eigen::VectorXd& mass) {
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(mesh.vertices(), mesh.vertices());
  mass = Eigen::VectorXd::Zero(mesh.vertices());
  for (Index f = 0; f < mesh.faces(); ++f) {
    const FaceOperators face = face_operators(mesh, f);
    const Eigen::MatrixXd local = face.laplacian();
    const auto ids = mesh.face(f);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      for (std::size_t j = 0; j < ids.size(); ++j) {
        L(ids[i], ids[j]) += local(static_cast<Index>(i), static_cast<Index>(j));
      }
      mass[ids[i]] += face.area() / static_cast<double>(ids.size());
    }
  }
  return L;
}

TEST(Assembly, LaplacianAndMassAreTheSumsOfTheFaces) {
  for (const OwnedMesh& owned : family()) {
    const LaplaceSystem system = assemble_laplacian(owned.view());
    Eigen::VectorXd mass;
    const Eigen::MatrixXd expected = dense_laplacian(owned.view(), mass);
    EXPECT_LT((Eigen::MatrixXd(system.L) - expected).norm(), 1e-10 * expected.norm());
    EXPECT_LT((system.mass - mass).norm(), 1e-12 * mass.norm());
  }
}

TEST(Assembly, ColumnsAreSortedAndTheMatrixSymmetricToTheBit) {
  for (const OwnedMesh& owned : family()) {
    const SparseMatrix L = assemble_laplacian(owned.view()).L;
    ASSERT_TRUE(L.isCompressed());
    for (Index c = 0; c < L.cols(); ++c) {
      for (int k = L.outerIndexPtr()[c]; k + 1 < L.outerIndexPtr()[c + 1]; ++k) {
        ASSERT_LT(L.innerIndexPtr()[k], L.innerIndexPtr()[k + 1]);
      }
    }
    const SparseMatrix T = L.transpose();
    EXPECT_EQ((L - T).norm(), 0.);
  }
}

TEST(Assembly, ConstantsAreTheKernelAndNothingIsPositive) {
  for (const OwnedMesh& owned : testing::digital_family()) {
    const SparseMatrix L = assemble_laplacian(owned.view()).L;
    EXPECT_LT((L * Eigen::VectorXd::Ones(L.cols())).norm(), 1e-12 * L.norm());
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen{Eigen::MatrixXd(L)};
    EXPECT_LT(eigen.eigenvalues().maxCoeff(), 1e-12 * L.norm());
  }
}

TEST(Assembly, ThreadsDoNotChangeABit) {
  OwnedMesh big = testing::digital_mesh(testing::ball(24), Vec3(1., 1.5, 0.5));
  testing::add_normals(big, 0.9, 3);
  for (const OwnedMesh& owned : {big, big.as_polygons(), testing::polygon_soup(2)}) {
    const LaplaceSystem one = assemble_laplacian(owned.view(), {}, Context{1});
    for (const int threads : {2, 4, 8}) {
      const LaplaceSystem many = assemble_laplacian(owned.view(), {}, Context{threads});
      ASSERT_EQ(one.L.nonZeros(), many.L.nonZeros());
      const Index n = one.L.nonZeros();
      EXPECT_TRUE(std::equal(one.L.outerIndexPtr(), one.L.outerIndexPtr() + one.L.cols() + 1,
                             many.L.outerIndexPtr()));
      EXPECT_TRUE(
          std::equal(one.L.innerIndexPtr(), one.L.innerIndexPtr() + n, many.L.innerIndexPtr()));
      EXPECT_TRUE(std::equal(one.L.valuePtr(), one.L.valuePtr() + n, many.L.valuePtr()));
      EXPECT_EQ(one.mass, many.mass);
      EXPECT_EQ(one.clamped_faces, many.clamped_faces);
    }
  }
}

TEST(Assembly, FacesInAnyOrderGiveTheSameSystem) {
  // So many vertices that they are filled in several blocks, with faces between the blocks, and
  // shuffled so that they are not.
  OwnedMesh ordered = testing::digital_mesh(testing::random_voxels(48, 5), Vec3(1., 1.5, 0.5));
  testing::add_normals(ordered, 1.5, 4);
  ASSERT_GT(ordered.view().vertices(), 3 * 32768);
  std::vector<std::size_t> order(ordered.surfels.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), std::mt19937(6));
  OwnedMesh shuffled = ordered;
  for (std::size_t f = 0; f < order.size(); ++f) {
    shuffled.surfels[f] = ordered.surfels[order[f]];
    for (std::size_t i = 0; i < 4; ++i) {
      shuffled.corners[4 * f + i] = ordered.corners[4 * order[f] + i];
    }
    for (std::size_t i = 0; i < 3; ++i) {
      shuffled.normals[3 * f + i] = ordered.normals[3 * order[f] + i];
    }
  }
  const LaplaceSystem a = assemble_laplacian(ordered.view(), {}, Context{1});
  const LaplaceSystem b = assemble_laplacian(shuffled.view());
  EXPECT_LT((a.L - b.L).norm(), 1e-13 * a.L.norm());
  EXPECT_LT((a.mass - b.mass).norm(), 1e-13 * a.mass.norm());
  EXPECT_GT(a.clamped_faces, 0);
  EXPECT_EQ(a.clamped_faces, b.clamped_faces);

  const LaplaceSystem c = assemble_laplacian(ordered.view(), {}, Context{4});
  EXPECT_TRUE(std::equal(a.L.valuePtr(), a.L.valuePtr() + a.L.nonZeros(), c.L.valuePtr()));
  EXPECT_EQ(a.mass, c.mass);
  EXPECT_EQ(a.clamped_faces, c.clamped_faces);
}

TEST(Assembly, RefillIsAFreshAssembly) {
  OwnedMesh owned = testing::digital_family()[2];
  const LaplacianPattern pattern(owned.view());
  LaplaceSystem system = pattern.assemble(owned.view());
  testing::add_normals(owned, 0.3, 99);
  const CalculusOptions options{0.4, 0.02};
  pattern.refill(system, owned.view(), options);
  const LaplaceSystem fresh = assemble_laplacian(owned.view(), options);
  EXPECT_EQ((system.L - fresh.L).norm(), 0.);
  EXPECT_EQ(system.mass, fresh.mass);
}

TEST(Assembly, LaplacianDependsOnRatiosOfSpacingsAndMassOnTheArea) {
  OwnedMesh owned = testing::digital_family()[0];
  const LaplaceSystem system = assemble_laplacian(owned.view());
  owned.spacing *= 8.;  // a power of two: exact
  const LaplaceSystem scaled = assemble_laplacian(owned.view());
  EXPECT_EQ((system.L - scaled.L).norm(), 0.);
  EXPECT_EQ((64. * system.mass - scaled.mass).norm(), 0.);
}

TEST(Assembly, SteepFacesAreCountedInTheReport) {
  OwnedMesh owned = testing::digital_mesh(testing::ball(3), Vec3::Ones());
  testing::add_normals(owned, 0., 1);
  EXPECT_EQ(assemble_laplacian(owned.view()).clamped_faces, 0);
  for (const int f : {2, 5}) {
    const Vec3 steep = owned.surfels[static_cast<std::size_t>(f)].normal().unitOrthogonal();
    std::copy(steep.data(), steep.data() + 3, owned.normals.begin() + 3 * f);
  }
  const Vec3 inward = -owned.surfels[7].normal();
  std::copy(inward.data(), inward.data() + 3, owned.normals.begin() + 21);
  EXPECT_EQ(assemble_laplacian(owned.view()).clamped_faces, 3);
  EXPECT_EQ(assemble_laplacian(owned.as_polygons().view()).clamped_faces, 3);
}

TEST(Assembly, CheckerboardIsInTheKernelOfMercatOnly) {
  const OwnedMesh owned = testing::digital_family()[0];
  Eigen::VectorXd board(owned.view().vertices());
  for (Index v = 0; v < board.size(); ++v) {
    const Vec3 p = owned.view().positions[v].cwiseQuotient(owned.spacing);
    const auto sum = std::lround(p.x() + p.y() + p.z() + 1.5);
    board[v] = sum % 2 == 0 ? 1. : -1.;
  }
  CalculusOptions options;
  EXPECT_GT((assemble_laplacian(owned.view(), options).L * board).norm(), 1.);
  options.stabilization = Stabilization::mercat;
  const SparseMatrix L = assemble_laplacian(owned.view(), options).L;
  EXPECT_LT((L * board).norm(), 1e-12 * L.norm());
}

TEST(Assembly, VertexOfNoFaceHasAnEmptyRow) {
  for (OwnedMesh owned : {testing::digital_family()[0], testing::polygon_soup(3)}) {
    const VertexId lonely = owned.add_vertex(Vec3::Zero());
    const LaplaceSystem system = assemble_laplacian(owned.view());
    EXPECT_EQ(system.L.col(lonely).nonZeros(), 0);
    EXPECT_EQ(system.mass[lonely], 0.);
  }
}

TEST(Assembly, EmptyMeshGivesAnEmptySystem) {
  const LaplaceSystem system = assemble_laplacian(FlatMesh{});
  EXPECT_EQ(system.L.rows(), 0);
  EXPECT_EQ(system.mass.size(), 0);
}

TEST(Assembly, BadInputIsRefusedAndNamed) {
  const auto message = [](const OwnedMesh& owned) -> std::string {
    try {
      assemble_laplacian(owned.view());
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  };
  const OwnedMesh good = testing::digital_family()[0];
  EXPECT_EQ(message(good), "accepted");

  OwnedMesh bad = good;
  bad.corners[4 * 11 + 2] = static_cast<VertexId>(good.positions.size());
  EXPECT_NE(message(bad).find("face 11"), std::string::npos) << message(bad);
  for (const double value : {std::nan(""), 7., std::numeric_limits<double>::infinity()}) {
    bad = good;
    bad.normals[3 * 13] = value;
    EXPECT_NE(message(bad).find("face 13"), std::string::npos) << message(bad);
    EXPECT_NE(message(bad.as_polygons()).find("face 13"), std::string::npos);
  }
  bad = good.as_polygons();
  for (int i = 0; i < 4; ++i) bad.corners[static_cast<std::size_t>(4 * 5 + i)] = 0;
  EXPECT_NE(message(bad).find("face 5"), std::string::npos) << message(bad);
  bad = good.as_polygons();
  bad.positions[static_cast<std::size_t>(3 * bad.corners[0])] = std::nan("");
  EXPECT_NE(message(bad).find("face"), std::string::npos);
  bad = good;
  bad.surfels[17].direction = 6;
  EXPECT_NE(message(bad).find("face 17"), std::string::npos);
  bad = good;
  bad.normals.resize(6);
  EXPECT_NE(message(bad), "accepted");
  bad = testing::polygon_soup(4);
  bad.offsets[1] = 2;
  EXPECT_NE(message(bad), "accepted");

  EXPECT_THROW(assemble_laplacian(good.view(), {0.}), UsageError);
  EXPECT_THROW(assemble_laplacian(good.view(), {std::nan("")}), UsageError);
  EXPECT_THROW(assemble_laplacian(good.view(), {1e7}), UsageError);
  EXPECT_THROW(assemble_laplacian(good.view(), {0.25, 0.}), UsageError);
  EXPECT_THROW(assemble_laplacian(good.view(), {0.25, 1.5}), UsageError);
  const CalculusOptions elements{0.25, 0.01, Stabilization::corrected_elements};
  EXPECT_NO_THROW(assemble_laplacian(good.view(), elements));
  EXPECT_THROW(assemble_laplacian(good.as_polygons().view(), elements), UsageError);
}

TEST(Assembly, CanBeCancelled) {
  const OwnedMesh owned = testing::digital_family()[0];
  Monitor monitor;
  monitor.cancel();
  EXPECT_THROW(assemble_laplacian(owned.view(), {}, Context{1, &monitor}), Cancelled);
}

}  // namespace
}  // namespace dsc
