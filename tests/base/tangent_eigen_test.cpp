#include "libdsc/base/tangent_eigen.h"

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace dsc {
namespace {

TEST(TangentEigen, HasTheEigenpairsOfTheProjectedMatrix) {
  srand(3);
  for (int i = 0; i < 200; ++i) {
    const Mat3 a = Mat3::Random();
    const Mat3 m = a + a.transpose();
    const Vec3 n = Vec3::Random().normalized();
    const Mat3 p = Mat3::Identity() - n * n.transpose();
    const TangentEigen e = tangent_eigen(m, n);
    EXPECT_LE(e.low, e.high);
    EXPECT_LT((p * m * e.low_direction - e.low * e.low_direction).norm(), 1e-14);
    EXPECT_LT((p * m * e.high_direction - e.high * e.high_direction).norm(), 1e-14);
    EXPECT_NEAR(e.low_direction.norm(), 1, 1e-14);
    EXPECT_NEAR(e.high_direction.norm(), 1, 1e-14);
    EXPECT_NEAR(e.low_direction.dot(e.high_direction), 0, 1e-14);
    EXPECT_NEAR(e.low_direction.dot(n), 0, 1e-14);
    EXPECT_NEAR(e.high_direction.dot(n), 0, 1e-14);
  }
}

TEST(TangentEigen, OfAMultipleOfTheIdentityHasSomeOrthonormalPair) {
  const TangentEigen e = tangent_eigen(-2 * Mat3::Identity(), Vec3::UnitZ());
  EXPECT_EQ(e.low, -2);
  EXPECT_EQ(e.high, -2);
  EXPECT_NEAR(std::abs(e.low_direction.cross(e.high_direction).z()), 1, 1e-15);
}

}  // namespace
}  // namespace dsc
