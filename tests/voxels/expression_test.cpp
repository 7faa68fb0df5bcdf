#include "libdsc/voxels/expression.h"

#include "libdsc/base/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>
#include <vector>

namespace dsc {
namespace {

TEST(Expression, ValuesAreThoseOfTheFormula) {
  const Vec3 p(0.3, -0.7, 1.9);
  const double x = p.x(), y = p.y(), z = p.z();
  EXPECT_DOUBLE_EQ(Expression("x + 2*y - z/4")(p), x + 2 * y - z / 4);
  EXPECT_DOUBLE_EQ(Expression("x^2 * sin(pi*y) + exp(z)")(p),
                   x * x * std::sin(M_PI * y) + std::exp(z));
  EXPECT_DOUBLE_EQ(Expression("-x^2")(p), -(x * x));
  EXPECT_DOUBLE_EQ(Expression("min(x, y, z) + max(x, abs(y))")(p), y + std::abs(y));
  EXPECT_DOUBLE_EQ(Expression("x >= y && z != 1 ? 3 : 4")(p), 3);
  EXPECT_DOUBLE_EQ(Expression("x == y ? 3 : 4")(p), 4);
  EXPECT_DOUBLE_EQ(Expression("7.5")(p), 7.5);
}

TEST(Expression, FaultsAreReportedWithTheirPosition) {
  const auto expect = [](const std::string& text, const std::string& part) {
    try {
      const Expression expression(text);
      ADD_FAILURE() << text << ": nothing was thrown";
    } catch (const UsageError& e) {
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << text << ": " << e.what();
    }
  };
  expect("", "empty");
  expect("  ", "empty");
  expect("x + w", "character 5");
  expect("x + ", "character");
  expect("(x", "character");
  expect("sin()", "character");
  expect("x = 3", "character 3");
  expect("x += 3", "character");
  expect("x, y", "comma");
  expect("x + \"text\"", "strings");
  expect("x\n", "printable");
  expect("x + é", "printable");
}

TEST(Expression, ValuesThatAreNotFiniteNameTheirPoint) {
  for (const char* text : {"1/x", "log10(x)", "sqrt(x-1)", "(x-1)^0.5"}) {
    SCOPED_TRACE(text);
    const Expression expression(text);
    try {
      (void)expression(Vec3(0, 2.5, 3));
      FAIL() << "nothing was thrown";
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("(0, 2.5, 3)"), std::string::npos) << e.what();
    }
  }
}

TEST(Expression, ManyPointsGiveTheValuesOfEachOnAnyThreads) {
  const Expression expression("x*y - z^3 + cos(x)");
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Random(3, 20000);
  const Vec3View view{points.data(), points.cols()};
  const Eigen::VectorXd one = expression(view, Context{1});
  const Eigen::VectorXd many = expression(view, Context{4});
  EXPECT_EQ(one, many);
  for (Index i = 0; i < points.cols(); i += 97) {
    const Vec3 p = points.col(i);
    EXPECT_DOUBLE_EQ(one[i], p.x() * p.y() - std::pow(p.z(), 3) + std::cos(p.x()));
  }
  points(0, 12345) = 1e200;
  points(1, 12345) = 1e200;
  EXPECT_THROW((void)expression(view), InputError);
}

TEST(Expression, ThreadsEvaluateAtTheSameTime) {
  const Expression expression("x + 10*y + 100*z");
  std::vector<double> sums(8, 0.);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < sums.size(); ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < 2000; ++i) sums[t] += expression(Vec3(double(t), i, 1));
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t t = 0; t < sums.size(); ++t) {
    EXPECT_DOUBLE_EQ(sums[t], 2000. * (double(t) + 100.) + 10. * 1999. * 1000.);
  }
}

}  // namespace
}  // namespace dsc
