#include "libdsc/normals/smallest_eigenvector.h"

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <random>

namespace dsc {
namespace {

Mat3 with_eigenvalues(const Vec3& values, std::mt19937& random, Mat3& axes) {
  std::normal_distribution<double> normal;
  axes = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
             .normalized()
             .toRotationMatrix();
  const Mat3 v = axes * values.asDiagonal() * axes.transpose();
  return 0.5 * (v + v.transpose());
}

TEST(SmallestEigenvector, IsAccurateToRoundingOverTheGap) {
  std::mt19937 random(1);
  for (const Vec3& values : {Vec3(0.1, 1, 2), Vec3(0, 1, 1), Vec3(0.3, 1, 1 + 1e-9),
                             Vec3(0, 1e-6, 1), Vec3(0.2, 0.201, 5), Vec3(1, 1 + 1e-7, 1 + 2e-7)}) {
    for (const double scale : {1e-200, 1., 1e40}) {
      for (int i = 0; i < 200; ++i) {
        Mat3 axes;
        const Mat3 v = with_eigenvalues(values * scale, random, axes);
        const SmallestEigenvector e = smallest_eigenvector(v);
        ASSERT_TRUE(e.unique);
        EXPECT_NEAR(e.u.norm(), 1, 1e-15);
        const double gap = (values[1] - values[0]) / values.sum();
        EXPECT_LT(e.u.cross(axes.col(0)).norm(), 1e-15 / gap) << values.transpose();
      }
    }
  }
}

TEST(SmallestEigenvector, SurvivesTracesWithoutAReciprocal) {
  std::mt19937 random(3);
  Mat3 axes;
  const Mat3 v = with_eigenvalues(Vec3(0.1, 1, 2) * 1e-309, random, axes);  // 14 digits are left
  const SmallestEigenvector e = smallest_eigenvector(v);
  ASSERT_TRUE(e.unique);
  EXPECT_LT(e.u.cross(axes.col(0)).norm(), 1e-12);
}

TEST(SmallestEigenvector, IsNotUniqueWhereEigenvaluesMeet) {
  std::mt19937 random(2);
  EXPECT_FALSE(smallest_eigenvector(Mat3::Zero()).unique);
  EXPECT_FALSE(smallest_eigenvector(Mat3::Identity()).unique);
  for (const Vec3& values : {Vec3(0, 0, 1), Vec3(1, 1, 1), Vec3(0.5, 0.5, 3)}) {
    for (int i = 0; i < 100; ++i) {
      Mat3 axes;
      const SmallestEigenvector e = smallest_eigenvector(with_eigenvalues(values, random, axes));
      EXPECT_FALSE(e.unique) << values.transpose();
      EXPECT_TRUE(e.u.isZero(0));
    }
  }
}

}  // namespace
}  // namespace dsc
