#include "libdsc/calculus/vertex_average.h"

#include "libdsc/base/error.h"
#include "libdsc/calculus/assembly.h"
#include "libdsc/normals/surface_normals.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/shapes.h"

#include <gtest/gtest.h>

#include <random>

namespace dsc {
namespace {

DigitalSurface sphere(double h) {
  DigitalSurface surface = extract_surface(digitize(Sphere(1.), Vec3(h, h, 1.3 * h)));
  analytic_normals(surface, Sphere(1.));
  return surface;
}

TEST(VertexAverage, KeepsConstantsAndTheIntegral) {
  const DigitalSurface surface = sphere(0.2);
  const FlatMesh mesh = surface.flat();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::MatrixXd values(2, mesh.faces());
  for (Index f = 0; f < mesh.faces(); ++f) values.col(f) << 7., uniform(random);
  const Eigen::MatrixXd averages = average_to_vertices(mesh, values);
  ASSERT_EQ(averages.cols(), mesh.vertices());
  EXPECT_LT((averages.row(0).array() - 7).abs().maxCoeff(), 1e-14);
  // Σ_v M0 average = Σ_f a_f value, a_f = |u·e| area, by hand.
  double integral = 0;
  for (Index f = 0; f < mesh.faces(); ++f) {
    const Vec3 e = surface.surfels()[static_cast<std::size_t>(f)].normal();
    const double area = mesh.spacing.prod() / mesh.spacing.dot(e.cwiseAbs());
    integral += values(1, f) * area * std::abs(mesh.normals[f].dot(e));
  }
  EXPECT_NEAR(assemble_laplacian(mesh).mass.dot(averages.row(1)), integral, 1e-12);
}

TEST(VertexAverage, NormalsApproachTheSpheresOwn) {
  const DigitalSurface surface = sphere(0.05);
  const VertexNormals normals = vertex_normals(surface.flat());
  EXPECT_EQ(normals.undefined, 0);
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    const Vec3 truth = surface.position(static_cast<VertexId>(v)).normalized();
    EXPECT_NEAR(normals.u.col(v).norm(), 1, 1e-14);
    EXPECT_LT((normals.u.col(v) - truth).norm(), 0.05);
  }
}

TEST(VertexAverage, AVertexOfNoFaceAndOneWhoseNormalsCancelHaveNoNormal) {
  // Two triangles back to back, and a vertex beside them.
  Eigen::Matrix3Xd positions(3, 4);
  positions << 0, 1, 0, 5, 0, 0, 1, 5, 0, 0, 0, 5;
  const std::vector<VertexId> corners{0, 1, 2, 0, 2, 1};
  const std::vector<Index> offsets{0, 3, 6};
  FlatMesh mesh;
  mesh.positions = {positions.data(), 4};
  mesh.corners = corners;
  mesh.offsets = offsets;
  const VertexNormals normals = vertex_normals(mesh);
  EXPECT_EQ(normals.undefined, 4);
  EXPECT_TRUE(normals.u.isZero(0));
  Eigen::MatrixXd values(1, 2);
  values << 1, 3;
  EXPECT_EQ(average_to_vertices(mesh, values), Eigen::RowVector4d(2, 2, 2, 0));
}

TEST(VertexAverage, RefusesWhatItCannotAverage) {
  const DigitalSurface surface = sphere(0.3);
  EXPECT_THROW(average_to_vertices(surface.flat(), Eigen::MatrixXd::Zero(1, 3)), UsageError);
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(1, surface.face_count());
  values(0, 5) = std::nan("");
  EXPECT_THROW(average_to_vertices(surface.flat(), values), InputError);
}

TEST(VertexAverage, HasTheSameBitsForAnyThreadCount) {
  const DigitalSurface surface = sphere(0.05);
  const Eigen::MatrixXd values = surface.normals().matrix();
  Context context;
  context.threads = 1;
  const Eigen::MatrixXd one = average_to_vertices(surface.flat(), values, {}, context);
  context.threads = 5;
  EXPECT_EQ(average_to_vertices(surface.flat(), values, {}, context), one);
}

}  // namespace
}  // namespace dsc
