#include "core/study/worst_hand/hand_space.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/study/worst_hand/cma_es.h"
#include "core/study/worst_hand/random.h"
#include "core/study/worst_hand/sobol.h"
#include "tests/core/study/worst_hand/search_scenes.h"

namespace hapticwall::worst_hand {
namespace {

using hapticwall::testing::tap_device;

TEST(HandSpace, PlacesAreLogarithmicBetweenTheBounds) {
  for (const Bounds bounds : {Bounds::kWide, Bounds::kNarrow}) {
    for (const double place : {0.0, 0.25, 0.3, 0.5, 0.999, 1.0}) {
      HandPoint point;
      point.fill(place);
      const HandValues values = values_at(point, bounds);
      for (std::size_t i = 0; i < kHandNumbers; ++i) {
        const ValueRange& range = kHandNumberList.at(i).ranges.at(static_cast<std::size_t>(bounds));
        const double expected = range.minimum * std::pow(range.maximum / range.minimum, place);
        EXPECT_NEAR(values.at(i), expected, 1e-12 * expected);
        EXPECT_EQ(is_at_bound(values, i, bounds), place == 0.0 || place > 0.99);
      }
    }
  }
}

TEST(HandSpace, TheHandRestsWithItsPressInTheWall) {
  const HandValues values{0.1, 200.0, 3.0, 1500.0, 2.0, 4.0, 0.1};
  const Scene scene = with_hand(tap_device("none", 1.0), values);
  const HandSettings& hand = *scene.x().hand;
  EXPECT_EQ(hand.mass_kg, 0.1);
  EXPECT_EQ(hand.stiffness_n_per_m, 200.0);
  EXPECT_EQ(hand.damping_n_s_per_m, 3.0);
  EXPECT_EQ(hand.grip_stiffness_n_per_m, 1500.0);
  EXPECT_EQ(hand.grip_damping_n_s_per_m, 2.0);
  // In balance the wall's spring and the hand's carry the same force.
  const double depth_m = 4.0 / 35000.0;
  EXPECT_NEAR(200.0 * (hand.path.front().position_m - 0.05 - depth_m), 4.0, 1e-9);
  EXPECT_FALSE(validate(scene));
}

TEST(HandSpace, ARampGoesFromTheHandleToTheSamePointAtItsSpeed) {
  const HandValues values{0.1, 200.0, 3.0, 1500.0, 2.0, 4.0, 0.1};
  Scene scene = tap_device("none", 1.0);
  scene.x().device.start_m = 0.04;
  const Scene let_go = with_hand(scene, values);
  const Scene ramp = with_hand(scene, values, Motion::kRamp);
  ASSERT_EQ(ramp.x().hand->path.size(), 2U);
  EXPECT_EQ(ramp.x().hand->path.front().position_m, 0.04);
  EXPECT_EQ(ramp.x().hand->path.back().position_m, let_go.x().hand->path.front().position_m);
  EXPECT_NEAR(rest_s(ramp), (0.05 + 0.02 + 4.0 / 35000.0 - 0.04) / 0.1, 1e-12);
  EXPECT_EQ(rest_s(let_go), 0.0);
  EXPECT_FALSE(validate(ramp));
}

TEST(HandSpace, RefusesScenesWithoutASearch) {
  Scene scene = tap_device("none", 1.0);
  EXPECT_FALSE(problem_of(scene, Bounds::kWide));
  scene.x().device.start_m = 0.06;
  EXPECT_EQ(problem_of(scene, Bounds::kWide)->key, "device.start_m");
  scene = tap_device("none", 1.0);
  scene.x().walls.front().position_m = 0.9;  // the softest hand would reach beyond 1 m
  EXPECT_EQ(problem_of(scene, Bounds::kWide)->key, "hand.path[0]");
  scene.x().walls.front().position_m = 0.5;
  EXPECT_FALSE(problem_of(scene, Bounds::kWide));
  scene.x().walls.front().stiffness_n_per_m = 0.0;
  EXPECT_EQ(problem_of(scene, Bounds::kWide)->key, "wall");
  scene.x().walls.clear();
  EXPECT_EQ(problem_of(scene, Bounds::kWide)->key, "wall");
}

// The author's first numbers for this seed.
TEST(HandSearchRandom, IsSplitMix64) {
  Random random(1234567);
  for (const std::uint64_t expected :
       {6457827717110365317U, 3203168211198807973U, 9817491932198370423U, 4593380528125082431U}) {
    EXPECT_EQ(random.bits(), expected);
  }
}

TEST(HandSearchRandom, NormalNumbersHaveTheirMoments) {
  Random random(1);
  constexpr int kCount = 20000;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double value = random.normal();
    sum += value;
    squares += value * value;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.03);
  EXPECT_NEAR(squares / kCount, 1.0, 0.03);
}

// Every interval of 1/1024 has one of 1024 points, in every dimension and with every shift.
TEST(HandSearchSobol, FillsEveryDimensionEvenly) {
  Random random(7);
  Sobol sobol(random, kHandNumbers);
  constexpr std::size_t kCount = 1024;
  std::array<std::array<int, kCount>, kHandNumbers> hits{};
  std::array<std::array<int, 1024>, kHandNumbers - 1> squares{};  // 32 by 32, neighbours
  for (std::size_t k = 0; k < kCount; ++k) {
    const HandPoint point = sobol.next();
    for (std::size_t i = 0; i < kHandNumbers; ++i) {
      ASSERT_GT(point.at(i), 0.0);
      ASSERT_LT(point.at(i), 1.0);
      ++hits.at(i).at(static_cast<std::size_t>(point.at(i) * kCount));
      if (i == 0) continue;
      const auto column = static_cast<std::size_t>(32.0 * point.at(i - 1));
      ++squares.at(i - 1).at(32 * column + static_cast<std::size_t>(32.0 * point.at(i)));
    }
  }
  for (const auto& dimension : hits) EXPECT_THAT(dimension, ::testing::Each(1));
  EXPECT_THAT(squares.front(), ::testing::Each(1));
}

HandPoint maximum_of(double (*score)(const HandPoint&)) {
  Random random(5);
  HandPoint start;
  start.fill(0.5);
  CmaEs<kHandNumbers> climber(start, 32);
  HandPoint best = start;
  for (int i = 0; i < 200 && !climber.is_over(); ++i) {
    const std::vector<HandPoint> points = climber.ask(random);
    std::vector<double> scores;
    for (const HandPoint& point : points) {
      scores.push_back(score(point));
      if (scores.back() > score(best)) best = point;
    }
    climber.tell(scores);
  }
  return best;
}

TEST(HandSearchClimb, FindsAMaximumInsideAndOneInACorner) {
  const HandPoint inside = maximum_of([](const HandPoint& p) {
    double sum = 1.0;
    for (std::size_t i = 0; i < kHandNumbers; ++i) {
      const double skew = i == 0 ? 0.0 : 0.7 * (p.at(i - 1) - 0.3);
      sum -= (p.at(i) - 0.3 + skew) * (p.at(i) - 0.3 + skew);
    }
    return sum;
  });
  for (const double place : inside) EXPECT_NEAR(place, 0.3, 0.02);
  const HandPoint corner = maximum_of([](const HandPoint& p) {
    return p[0] + 2.0 * p[1] - p[2] - p[3] + 0.5 * p[4] - 3.0 * p[5] + p[6] + 10.0;
  });
  const HandPoint expected{1.0, 1.0, 0.0, 0.0, 1.0, 0.0, 1.0};
  for (std::size_t i = 0; i < kHandNumbers; ++i) EXPECT_NEAR(corner.at(i), expected.at(i), 1e-3);
}

}  // namespace
}  // namespace hapticwall::worst_hand
