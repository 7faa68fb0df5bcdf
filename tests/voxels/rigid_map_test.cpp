#include "libdsc/voxels/rigid_map.h"

#include "libdsc/base/error.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <limits>

namespace dsc {
namespace {

Mat3 turn(double angle) {
  return Eigen::AngleAxisd(angle, Vec3(1, 2, -2).normalized()).toRotationMatrix();
}

TEST(RigidMap, KeepsLengthsAndComesBack) {
  for (const double mirror : {1., -1.}) {
    const RigidMap map =
        rigid_map(turn(0.7) * Eigen::DiagonalMatrix<double, 3>(1, mirror, 1), {10, -20, 30});
    EXPECT_EQ(map.mirrors(), mirror < 0);
    EXPECT_FALSE(map.is_identity());
    const Vec3 p(1, 2, 3), q(-4, 0.5, 6);
    EXPECT_NEAR((map(p) - map(q)).norm(), (p - q).norm(), 1e-13);
    EXPECT_LT((map.inverse(map(p)) - p).norm(), 1e-13);
    EXPECT_LT((map.turned(p - q) - (map(p) - map(q))).norm(), 1e-13);
  }
  EXPECT_TRUE(RigidMap{}.is_identity());
}

TEST(RigidMap, RoundedCosinesBecomeOrthogonal) {
  const Mat3 exact = turn(1.1);
  const RigidMap map = rigid_map(exact.cast<float>().cast<double>(), Vec3::Zero());
  EXPECT_LT((map.rotation.transpose() * map.rotation - Mat3::Identity()).norm(), 1e-14);
  EXPECT_LT((map.rotation - exact).norm(), 1e-6);
}

double off(const Mat3& r) { return (r.transpose() * r - Mat3::Identity()).cwiseAbs().maxCoeff(); }

/// A rotation or a reflection of a random one, as `turns` products leave it.
Mat3 random_turn(int turns) {
  Mat3 r = Mat3::Identity();
  for (int i = 0; i < turns; ++i) r *= Eigen::Quaterniond::UnitRandom().toRotationMatrix();
  return r;
}

TEST(RigidMap, OrthogonalCosinesAreKeptToTheLastBit) {
  for (int i = 0; i < 2000; ++i) {
    Mat3 r = random_turn(1 + i % 8);
    if (i % 2 == 1) r.col(i % 3) *= -1.;
    ASSERT_EQ(rigid_map(r, Vec3::Zero()).rotation, r) << off(r);
    // What was made orthogonal is so from then on.
    const Mat3 made = rigid_map(r.cast<float>().cast<double>(), Vec3::Zero()).rotation;
    ASSERT_EQ(rigid_map(made, Vec3::Zero()).rotation, made) << off(made);
  }
}

TEST(RigidMap, IsOrthogonalUpToRoundingWhateverIsGiven) {
  for (const double size : {1e-3, 1e-6, 1e-9, 1e-12, 1e-13, 1e-14, 1e-15}) {
    for (int i = 0; i < 200; ++i) {
      const Mat3 given = random_turn(1) + 0.2 * size * Mat3::Random();
      const RigidMap map = rigid_map(given, Vec3::Zero());
      ASSERT_LE(off(map.rotation), 1e-14) << size;
      ASSERT_LE((map.rotation - given).norm(), 2 * size + 1e-14) << size;
    }
  }
}

TEST(RigidMap, ShearsScalesAndNaNAreRefused) {
  Mat3 sheared = Mat3::Identity();
  sheared(0, 1) = 0.1;
  EXPECT_THROW((void)rigid_map(sheared, Vec3::Zero()), InputError);
  EXPECT_THROW((void)rigid_map(2. * Mat3::Identity(), Vec3::Zero()), InputError);
  EXPECT_THROW((void)rigid_map(Mat3::Zero(), Vec3::Zero()), InputError);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)rigid_map(Mat3::Identity() * nan, Vec3::Zero()), InputError);
  EXPECT_THROW((void)rigid_map(Mat3::Identity(), {0, nan, 0}), InputError);
}

}  // namespace
}  // namespace dsc
