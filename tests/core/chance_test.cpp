#include "core/chance.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hapticwall {
namespace {

struct Row {
  int seed;
  std::size_t axis;
  Purpose purpose;
  std::uint64_t tick;
  double uniform;
  double normal;
};

// Computed in Python with whole numbers of any length.
TEST(Chance, HasTheNumbersOfAnotherProgram) {
  for (const Row& row :
       {Row{1, 0, Purpose::kLostTick, 0, 0.6935121390102292, 1.4448885917663574},
        Row{1, 0, Purpose::kLostTick, 1, 0.35901266185210323, 1.1012043952941895},
        Row{7, 1, Purpose::kPeriod, 12345, 0.8385662164059494, -0.01663494110107422},
        Row{2147483647, 0, Purpose::kPositionNoise, 10'000'000'000, 0.9287121021405439,
            -1.4592256546020508}}) {
    const Chance chance(row.seed, row.axis, row.purpose);
    EXPECT_EQ(chance.uniform(row.tick), row.uniform) << row.tick;
    EXPECT_EQ(chance.normal(row.tick), row.normal) << row.tick;
  }
}

// Mean, variance, correlation of neighbours and share beyond 3, each within four standard errors of
// what twelve uniform numbers have.
TEST(Chance, IsUniformAndNearlyNormal) {
  constexpr int kCount = 400'000;
  const Chance chance(3, 0, Purpose::kForceNoise);
  double uniform = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  double neighbours = 0.0;
  double last = 0.0;
  int far = 0;
  for (int tick = 0; tick < kCount; ++tick) {
    const double u = chance.uniform(static_cast<std::uint64_t>(tick));
    const double z = chance.normal(static_cast<std::uint64_t>(tick));
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    ASSERT_LT(std::abs(z), 6.0);
    uniform += u;
    sum += z;
    squares += z * z;
    neighbours += z * last;
    far += std::abs(z) > 3.0 ? 1 : 0;
    last = z;
  }
  const double error = 4.0 / std::sqrt(static_cast<double>(kCount));
  EXPECT_NEAR(uniform / kCount, 0.5, error * std::sqrt(1.0 / 12.0));
  EXPECT_NEAR(sum / kCount, 0.0, error);
  EXPECT_NEAR(squares / kCount, 1.0, error * std::sqrt(2.0));
  EXPECT_NEAR(neighbours / kCount, 0.0, error);
  // 2 P(S > 9) of the sum of twelve, by Irwin and Hall: 2 (3^12 - 12 2^12 + 66)/12! = 0.002013.
  constexpr double kBeyond = 2.0 * (531441.0 - 12.0 * 4096.0 + 66.0) / 479001600.0;
  EXPECT_NEAR(static_cast<double>(far) / kCount, kBeyond, error * std::sqrt(kBeyond));
}

TEST(Chance, DiffersByAxisAndPurpose) {
  const Chance first(1, 0, Purpose::kPositionNoise);
  EXPECT_NE(first.normal(5), Chance(1, 1, Purpose::kPositionNoise).normal(5));
  EXPECT_NE(first.normal(5), Chance(1, 0, Purpose::kForceNoise).normal(5));
  EXPECT_NE(first.normal(5), Chance(2, 0, Purpose::kPositionNoise).normal(5));
}

}  // namespace
}  // namespace hapticwall
