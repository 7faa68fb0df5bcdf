#include "libdsc/io/world_result.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace dsc {
namespace {

/// Twice the vector area of face f.
Vec3 vector_area(const FlatMesh& mesh, Index f) {
  const auto face = mesh.face(f);
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < face.size(); ++i) {
    sum += mesh.positions[face[i]].cross(mesh.positions[face[(i + 1) % face.size()]]);
  }
  return sum;
}

/// A triangle and a quad, with a vector on the faces and a scalar on the vertices.
struct Sample {
  Eigen::Matrix3Xd positions = Eigen::Matrix3Xd::Random(3, 5);
  Eigen::Matrix3Xd normals = Eigen::Matrix3Xd::Random(3, 2);
  Eigen::VectorXd heat = Eigen::VectorXd::Random(5);
  std::vector<VertexId> corners{0, 1, 2, 2, 1, 3, 4};
  std::vector<Index> offsets{0, 3, 7};
  Result result;

  Sample() {
    result.mesh.positions = {positions.data(), 5};
    result.mesh.corners = corners;
    result.mesh.offsets = offsets;
    result.fields = {scalar_field("heat", FieldOn::vertex, heat),
                     vector_field("normal", {"nx", "ny", "nz"}, FieldOn::face,
                                  {normals.data(), normals.cols()})};
  }
};

TEST(WorldResult, MapsPositionsAndVectorsAndLeavesScalars) {
  const Sample s;
  for (const double mirror : {1., -1.}) {
    const RigidMap map{Eigen::AngleAxisd(0.4, Vec3::UnitY()).toRotationMatrix() *
                           Eigen::DiagonalMatrix<double, 3>(mirror, 1, 1),
                       {3, 4, 5}};
    const WorldResult world(s.result, map);
    const Result& r = world.get();
    for (Index v = 0; v < 5; ++v) {
      EXPECT_EQ(r.mesh.positions[v], map(s.positions.col(v)));
      EXPECT_EQ(r.fields[0].values[static_cast<std::size_t>(v)], s.heat[v]);
    }
    for (Index f = 0; f < 2; ++f) {
      const Vec3View normals{r.fields[1].values.data(), 2};
      EXPECT_EQ(normals[f], map.rotation * s.normals.col(f));
      // A vector area is no vector: it turns over with a mirror unless the corners do.
      const Vec3 area = vector_area(s.result.mesh, f);
      EXPECT_LT((vector_area(r.mesh, f) - map.turned(area)).norm(), 1e-12);
      EXPECT_EQ(r.mesh.face(f)[0], s.result.mesh.face(f)[0]);
    }
  }
}

TEST(WorldResult, TheIdentityCopiesNothing) {
  const Sample s;
  const WorldResult world(s.result, RigidMap{});
  EXPECT_EQ(world.get().mesh.positions.data, s.positions.data());
  EXPECT_EQ(world.get().mesh.corners.data(), s.corners.data());
  EXPECT_EQ(world.get().fields[1].values.data(), s.normals.data());
}

}  // namespace
}  // namespace dsc
