#include "libdsc/truth/field_transfer.h"

#include "libdsc/base/error.h"
#include "libdsc/truth/projection.h"
#include "libdsc/truth/smooth_mesh.h"
#include "libdsc/voxels/shapes.h"
#include "tests/truth/shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dsc::truth {
namespace {

using test::view;

const Vec3 kSlope(0.3, -0.7, 0.5);

/// The largest error of a linear function, given at the surface's positions (the pointels or what
/// they project to), on the vertices of `mesh`.
double linear_error(const DigitalSurface& surface, Vec3View positions, const TriangleMesh& mesh) {
  const FieldTransfer transfer = field_transfer(surface.flat(), positions, mesh.positions());
  const Eigen::VectorXd field = positions.matrix().transpose() * kSlope;
  return (transfer.vertex_weights * field - mesh.vertices.transpose() * kSlope)
      .cwiseAbs()
      .maxCoeff();
}

TEST(FieldTransfer, OfALinearFunctionIsOfFirstOrderAndOfSecondAtProjectedPositions) {
  const Goursat shape;
  const TriangleMesh mesh = smooth_mesh(shape, {1.}).mesh;
  const SurfaceProjection projection(shape, mesh);
  double raw = 0, projected = 0;
  for (const double h : {1., 0.5, 0.25}) {
    const DigitalSurface surface = test::digital_surface(shape, h);
    const ProjectedPoints on_surface = projection.project(surface.positions());
    ASSERT_EQ(on_surface.failures, 0);
    const double raw_next = linear_error(surface, surface.positions(), mesh);
    const double projected_next = linear_error(surface, view(on_surface.points), mesh);
    EXPECT_LE(raw_next, kSlope.norm() * h);
    EXPECT_LE(projected_next, raw_next / 3.);
    if (raw > 0) {
      EXPECT_GT(raw / raw_next, 1.6);
      EXPECT_GT(projected / projected_next, 3.);
    }
    raw = raw_next;
    projected = projected_next;
  }
}

TEST(FieldTransfer, WeightsAreAPartitionOfOne) {
  const Torus shape(1., 0.4);
  const DigitalSurface surface = test::digital_surface(shape, 0.1);
  const TriangleMesh mesh = smooth_mesh(shape, {0.1}).mesh;
  const FieldTransfer transfer = field_transfer(surface.flat(), {}, mesh.positions());
  EXPECT_EQ(transfer.vertex_weights.rows(), mesh.vertex_count());
  EXPECT_EQ(transfer.vertex_weights.cols(), surface.vertex_count());
  const Eigen::VectorXd sums =
      transfer.vertex_weights * Eigen::VectorXd::Ones(surface.vertex_count());
  EXPECT_LE((sums.array() - 1.).abs().maxCoeff(), 1e-15);
  EXPECT_GE(transfer.vertex_weights.coeffs().minCoeff(), 0.);
}

TEST(FieldTransfer, OfFacesIsTheClosestFace) {
  const Sphere shape;
  const double h = 0.1;
  const DigitalSurface surface = test::digital_surface(shape, h);
  Eigen::Matrix3Xd centres(3, surface.face_count());
  for (Index f = 0; f < surface.face_count(); ++f) {
    centres.col(f) = surface.surfels()[static_cast<std::size_t>(f)].centre(surface.grid());
  }
  const FieldTransfer transfer = field_transfer(surface.flat(), {}, view(centres));
  for (Index f = 0; f < surface.face_count(); ++f) {
    ASSERT_EQ(transfer.faces[static_cast<std::size_t>(f)], f);
  }
  const Eigen::MatrixXd back = transfer.of_faces(centres.transpose());
  EXPECT_EQ(back, centres.transpose());
  EXPECT_THROW(transfer.of_faces(Eigen::MatrixXd::Zero(3, 1)), UsageError);
}

TEST(FieldTransfer, RefusesPositionsOfAnotherSurface) {
  const DigitalSurface surface = test::digital_surface(Sphere(), 0.5);
  const Eigen::Matrix3Xd two = Eigen::Matrix3Xd::Zero(3, 2);
  EXPECT_THROW(field_transfer(surface.flat(), view(two), view(two)), UsageError);
}

}  // namespace
}  // namespace dsc::truth
