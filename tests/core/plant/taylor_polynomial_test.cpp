#include "core/plant/taylor_polynomial.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <random>

namespace hapticwall {
namespace {

// scale * Π (θ - root)
TaylorPolynomial<double> with_roots(std::initializer_list<double> roots, double scale) {
  TaylorPolynomial<double> p;
  p.coefficient[0] = scale;
  std::size_t degree = 0;
  for (const double root : roots) {
    for (std::size_t j = ++degree; j > 0; --j) {
      p.coefficient[j] = p.coefficient[j - 1] - root * p.coefficient[j];
    }
    p.coefficient[0] *= -root;
  }
  return p;
}

TEST(TaylorPolynomial, IntegralsAreThoseOfThePolynomial) {
  TaylorPolynomial<double> p;
  p.coefficient[0] = 2.0;
  p.coefficient[3] = -4.0;
  TaylorPolynomial<double> q;
  q.coefficient[1] = 3.0;
  EXPECT_DOUBLE_EQ(p.at(0.5), 2.0 - 0.5);
  EXPECT_DOUBLE_EQ(p.slope_at(0.5), -3.0);
  EXPECT_DOUBLE_EQ(p.integral_to(0.5), 1.0 - 0.0625);
  // ∫ (2 - 4θ³) 3θ = 3θ² - 12/5 θ⁵
  const auto products = product_integrals<double, 2>({&p, &q}, q, 0.5);
  EXPECT_DOUBLE_EQ(products[0], 0.75 - 12.0 / 5.0 / 32.0);
  EXPECT_DOUBLE_EQ(products[1], 0.375);  // 3θ³
}

TEST(FirstCrossing, FindsTheFirstOfMany) {
  EXPECT_NEAR(first_crossing(with_roots({0.3, 0.6, 0.9}, -1.0), 1.0).value(), 0.3, 1e-15);
  EXPECT_NEAR(first_crossing(with_roots({0.3, 0.6, 0.9}, 1.0), -1.0).value(), 0.3, 1e-15);
}

TEST(FirstCrossing, SeesADipThatEndsBeforeTheEnd) {
  // The polynomial is positive at both ends; the dip between is a hundred-thousandth wide.
  EXPECT_NEAR(first_crossing(with_roots({0.5, 0.50001}, 1.0), 1.0).value(), 0.5, 1e-10);
}

TEST(FirstCrossing, IgnoresATouchAndWhatLiesOutside) {
  TaylorPolynomial<double> touch = with_roots({0.5, 0.5}, 1.0);
  touch.coefficient[0] += 1e-12;
  EXPECT_EQ(first_crossing(touch, 1.0), std::nullopt);
  EXPECT_EQ(first_crossing(with_roots({1.5}, -1.0), 1.0), std::nullopt);
  EXPECT_EQ(first_crossing(with_roots({-0.5}, 1.0), 1.0), std::nullopt);
}

TEST(FirstCrossing, FromZeroLooksWhereItLeads) {
  TaylorPolynomial<double> rises;
  rises.coefficient[1] = 1.0;
  EXPECT_EQ(first_crossing(rises, 1.0), std::nullopt);
  EXPECT_EQ(first_crossing(rises, -1.0), std::optional<double>(0.0));
  TaylorPolynomial<double> rises_and_returns = rises;  // θ - 2θ²: back at 1/2
  rises_and_returns.coefficient[2] = -2.0;
  EXPECT_NEAR(first_crossing(rises_and_returns, 1.0).value(), 0.5, 1e-15);
  EXPECT_EQ(first_crossing(TaylorPolynomial<double>{}, 1.0), std::nullopt);
}

// Against a dense scan, for random polynomials whose coefficients grow or fall by `ratio`: with
// many changes of sign, or monotone.
void compare_with_a_dense_scan(double ratio) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> coefficient(-1.0, 1.0);
  constexpr int kScan = 20000;
  int crossings = 0;
  for (int trial = 0; trial < 300; ++trial) {
    TaylorPolynomial<double> p;
    for (int j = 0; j <= 8; ++j) {
      p.coefficient[static_cast<std::size_t>(j)] = coefficient(random) * std::pow(ratio, j);
    }
    const double sign = p.coefficient[0] > 0.0 ? 1.0 : -1.0;
    const auto found = first_crossing(p, sign);
    double scanned = -1.0;
    for (int i = 1; i <= kScan && scanned < 0.0; ++i) {
      const double theta = static_cast<double>(i) / kScan;
      if (sign * p.at(theta) < 0.0) scanned = theta;
    }
    if (scanned >= 0.0) {
      ++crossings;
      ASSERT_TRUE(found.has_value());
      EXPECT_LE(*found, scanned + 1e-12);
    }
    if (found) EXPECT_NEAR(p.at(*found), 0.0, 1e-9);
    if (found && scanned >= 0.0) EXPECT_GE(*found, scanned - 1.0 / kScan - 1e-12);
  }
  EXPECT_GT(crossings, 20);
}
TEST(FirstCrossing, AgreesWithADenseScan) {
  compare_with_a_dense_scan(3.0);
  compare_with_a_dense_scan(0.4);
}

}  // namespace
}  // namespace hapticwall
