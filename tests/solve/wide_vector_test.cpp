#include "libdsc/solve/wide_vector.h"

#include "libdsc/solve/ldlt_factor.h"
#include "tests/solve/grid_systems.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dsc {
namespace {

using testing::grid_laplacian;
using testing::identity;
using testing::scrambled;

TEST(Wide, AddsAsLongDoublesDoInTheirRange) {
  // x86's long double has 15 exponent bits: an independent reference for exponents up to 16000.
  const Eigen::VectorXd m = scrambled(4000, 3);
  const Eigen::VectorXd s = scrambled(4000, 4);
  for (Index i = 0; i + 1 < 4000; i += 2) {
    const int e1 = static_cast<int>(20 * s[i]),
              e2 = static_cast<int>(20 * s[i]) + static_cast<int>(3 * s[i + 1]);
    Wide w{m[i], e1};
    w.add(m[i + 1], e2);
    const long double expected = std::ldexp(static_cast<long double>(m[i]), 256 * e1) +
                                 std::ldexp(static_cast<long double>(m[i + 1]), 256 * e2);
    const long double got = std::ldexp(static_cast<long double>(w.mantissa), 256 * w.exponent);
    EXPECT_LE(std::abs(got - expected), 2e-16L * std::abs(expected));
  }
}

TEST(Wide, TinyFactorsAreNotLost) {
  Wide w{0x1p-100, -3};
  w.add(0x1p-1000, 0);  // 2^-868 + 2^-1000
  EXPECT_EQ(std::ldexp(w.mantissa, 256 * w.exponent + 868), 1.);
  Wide v{0x1p-100, -5};  // 2^-1380, far below
  v.add(0x1p-1000, 0);
  EXPECT_EQ(std::ldexp(static_cast<long double>(v.mantissa), 256 * v.exponent), 0x1p-1000L);
}

TEST(Wide, NormalisingKeepsTheValue) {
  for (const double m : {0x1p-1060, -0x1p1000, 0.3}) {
    Wide w{m, 7};
    w.normalise();
    EXPECT_GE(std::abs(w.mantissa), Wide::kLow);
    EXPECT_LT(std::abs(w.mantissa), Wide::kHigh);
    EXPECT_EQ(std::ldexp(static_cast<long double>(w.mantissa), 256 * (w.exponent - 7)), m);
  }
}

TEST(LdltFactor, BothOrdersAndBothArithmeticsAgree) {
  const SparseMatrix A = grid_laplacian(40, 50) + 0.3 * identity(2000);
  const Eigen::VectorXd b = scrambled(2000);
  const Eigen::VectorXd x = LdltFactor(A).solve(b);
  EXPECT_LT((A * x - b).norm(), 1e-12 * b.norm());
  for (const FillOrder order : {FillOrder::nested_dissection, FillOrder::minimum_degree}) {
    const LdltFactor factor(A, order);
    EXPECT_LT((factor.solve(b) - x).norm(), 1e-12);
    WideVector w(2000);
    for (Index i = 0; i < 2000; ++i) w.set(i, {b[i], 0});
    factor.solve_in_place(w);
    for (Index i = 0; i < 2000; ++i) EXPECT_NEAR(w.relative_to(i, 0), x[i], 1e-13);
  }
}

TEST(LdltFactor, WideSolvesReachBeyondDoublesRange) {
  // A path with weights 1 and mass 1 decays by the root q < 1 of q + 1/q = 3: after 3000 steps,
  // q^3000 = e^-2887.
  const Index n = 3100;
  const SparseMatrix A = grid_laplacian(n, 1) + identity(n);
  const double decay = std::log((3 - std::sqrt(5.)) / 2);
  const LdltFactor factor(A, FillOrder::minimum_degree);
  WideVector w(n);
  w.set(0, {1, 0});
  factor.solve_in_place(w);
  for (Index i = 1; i <= 3000; ++i) EXPECT_NEAR(w.log(i) - w.log(i - 1), decay, 1e-12) << i;
}

}  // namespace
}  // namespace dsc
