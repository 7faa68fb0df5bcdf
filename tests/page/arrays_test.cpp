// The errors that arrays.h states hold for whatever comes.
#include "libdsc/page/arrays.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace dsc {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

float float_of(std::int32_t bits) { return std::bit_cast<float>(bits); }

Vec3 position_of(const detail::PagePositions& kept, std::size_t v) {
  Vec3 p;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int32_t k = kept.values[3 * v + axis];
    const auto a = static_cast<Index>(axis);
    p[a] = kept.origin[a] + kept.step[a] * (kept.lattice ? k : static_cast<double>(float_of(k)));
  }
  return p;
}

TEST(PagePositions, OfALatticeAreIntegers) {
  std::mt19937 random(1);
  const Vec3 origin(-1234.5678, 0.1, 77.), spacing(0.1, 1. / 3., 2.5);
  Eigen::Matrix3Xd points(3, 2000);
  for (Index v = 0; v < points.cols(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      points(axis, v) = origin[axis] + spacing[axis] * (static_cast<int>(random() % 4000) - 0.5);
    }
  }
  const auto kept = detail::page_positions({points.data(), points.cols()}, spacing);
  ASSERT_TRUE(kept.lattice);
  for (Index v = 0; v < points.cols(); ++v) {
    const Vec3 error = position_of(kept, static_cast<std::size_t>(v)) - points.col(v);
    EXPECT_LE((error.cwiseAbs().cwiseQuotient(spacing)).maxCoeff(), 1e-9);
  }
}

TEST(PagePositions, OffTheLatticeAreFloats) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  for (const double scale : {1., 1e-300, 1e-3, 1e30, 8e307}) {
    for (const double shift : {0., 1.}) {
      Eigen::Matrix3Xd points(3, 500);
      for (Index i = 0; i < points.size(); ++i) {
        points.data()[i] = scale * uniform(random) + shift * scale;
      }
      const auto kept = detail::page_positions({points.data(), points.cols()}, Vec3(1., 1., 1.));
      EXPECT_FALSE(kept.lattice);
      const double half =
          (0.5 * points.rowwise().maxCoeff() - 0.5 * points.rowwise().minCoeff()).maxCoeff();
      EXPECT_LE(kept.step[0], 2. * half);
      for (Index v = 0; v < points.cols(); ++v) {
        const Vec3 error = position_of(kept, static_cast<std::size_t>(v)) - points.col(v);
        EXPECT_LE(error.cwiseAbs().maxCoeff(), 0x1p-24 * 1.001 * kept.step[0] + 1e-15 * scale);
      }
    }
  }
}

TEST(PagePositions, ALittleOffTheLatticeIsOff) {
  Eigen::Matrix3Xd points(3, 3);
  points << 0, 1, 2, 0, 1, 0, 0, 0, 1;
  EXPECT_TRUE(detail::page_positions({points.data(), 3}, Vec3(1., 1., 1.)).lattice);
  points(1, 2) = 1e-6;
  EXPECT_FALSE(detail::page_positions({points.data(), 3}, Vec3(1., 1., 1.)).lattice);
}

TEST(PageValues, KeepSevenDigitsOfAnyDouble) {
  std::mt19937_64 random(3);
  for (const int from : {-1074, -500, -120, -20, 0, 100, 900}) {  // least exponents of a field
    std::vector<double> values{0., -0., kInfinity, -kInfinity};
    double largest = 0;
    for (int i = 0; i < 2000; ++i) {
      const double mantissa = 1. + static_cast<double>(random() >> 12) * 0x1p-52;
      const int exponent = std::min(from + static_cast<int>(random() % 125), 1023);
      values.push_back(std::ldexp(random() % 2 == 0 ? mantissa : -mantissa, exponent));
      largest = std::max(largest, std::abs(values.back()));
    }
    if (from == 900) values.push_back(largest = std::numeric_limits<double>::max());
    const auto kept = detail::page_values(values);
    ASSERT_EQ(kept.values.size(), values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double read = float_of(kept.values[i]) * std::exp2(kept.exponent);
      if (std::isinf(values[i])) {
        EXPECT_EQ(read, values[i]);
        continue;
      }
      const double bound = std::max(0x1p-24 * std::abs(values[i]), 1e-15 * largest);
      EXPECT_LE(std::abs(read - values[i]), bound) << values[i];
    }
  }
}

TEST(PageNormals, AreRightToATenThousandthOfARadian) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  Eigen::Matrix3Xd u(3, 5000);
  for (Index i = 0; i < u.size(); ++i) u.data()[i] = normal(random);
  for (int axis = 0; axis < 3; ++axis) {  // the corners of the octahedron, and points on its edges
    u.col(2 * axis) = Vec3::Unit(axis);
    u.col(2 * axis + 1) = -Vec3::Unit(axis);
    u(axis, 10 + axis) = 0;
  }
  u.colwise().normalize();
  const auto kept = detail::page_normals({u.data(), u.cols()});
  for (Index f = 0; f < u.cols(); ++f) {
    // The point of the unfolded octahedron |x| + |y| + |z| = 1, from the definition.
    double x = kept[static_cast<std::size_t>(2 * f)] / 32767.;
    double y = kept[static_cast<std::size_t>(2 * f + 1)] / 32767.;
    const double z = 1. - std::abs(x) - std::abs(y);
    if (z < 0) {
      const double before = x;
      x = std::copysign(1. - std::abs(y), before);
      y = std::copysign(1. - std::abs(before), y);
    }
    const Vec3 read = Vec3(x, y, z).normalized();
    EXPECT_LE((read - u.col(f)).norm(), 1e-4) << u.col(f).transpose();
  }
}

}  // namespace
}  // namespace dsc
