#include "core/environment/portable_math.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hapticwall {
namespace {

// The reference is the C library's, in extended precision.
TEST(PortableMath, TheSineOfTurnsIsExactToTheLastDigits) {
  double worst = 0.0;
  for (int i = -40'000; i <= 40'000; ++i) {
    const double turns = static_cast<double>(i) * 1.23456789e-4;
    const long double whole = std::floor(static_cast<long double>(turns) + 0.5L);
    const long double rest = static_cast<long double>(turns) - whole;
    const long double exact = std::sin(2.0L * std::numbers::pi_v<long double> * rest);
    worst = std::max(worst, std::abs(static_cast<double>(sine_of_turns(turns) - exact)));
  }
  EXPECT_LT(worst, 4e-16);
  EXPECT_GT(worst, 1e-17) << "the reference has other digits, or nothing was compared";
}

TEST(PortableMath, QuarterTurnsHaveExactSines) {
  EXPECT_EQ(sine_of_turns(0.0), 0.0);
  EXPECT_EQ(sine_of_turns(1.0), 0.0);
  EXPECT_EQ(sine_of_turns(-3.0), 0.0);
  EXPECT_NEAR(sine_of_turns(0.25), 1.0, 2.3e-16);
  EXPECT_NEAR(sine_of_turns(7.75), -1.0, 2.3e-16);
}

TEST(PortableMath, TheExponentialIsExactToTheLastDigits) {
  double worst = 0.0;
  for (int i = 0; i <= 60'000; ++i) {
    const double s = static_cast<double>(i) * 9.87654321e-4;  // up to 59
    const long double exact = std::exp(-static_cast<long double>(s));
    worst = std::max(worst, std::abs(static_cast<double>((exp_of_minus(s) - exact) / exact)));
  }
  EXPECT_LT(worst, 1e-15);
  EXPECT_GT(worst, 1e-17);
}

TEST(PortableMath, TheExponentialKeepsItsEnds) {
  EXPECT_EQ(exp_of_minus(0.0), 1.0);
  EXPECT_EQ(exp_of_minus(1e4), 0.0);
  EXPECT_EQ(exp_of_minus(INFINITY), 0.0);
  EXPECT_EQ(exp_of_minus(NAN), 0.0);
}

}  // namespace
}  // namespace hapticwall
