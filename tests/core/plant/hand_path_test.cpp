#include "core/plant/hand_path.h"

#include <gtest/gtest.h>

#include <memory>

namespace hapticwall {
namespace {

TEST(HandPath, RampsAndHolds) {
  HandPath path({{0.0, 0.03}, {0.3, 0.06}}, 1000.0);
  for (int tick = 0; tick < 600; ++tick) {
    const double expected = tick < 300 ? 0.03 + 0.1 * tick * 1e-3 : 0.06;
    ASSERT_NEAR(path.position_m(), expected, 1e-16) << tick;
    ASSERT_NEAR(path.velocity_m_per_s(), tick < 300 ? 0.1 : 0.0, 1e-15) << tick;
    ASSERT_FALSE(path.bends_within_tick()) << tick;
    path.next_tick();
  }
}

TEST(HandPath, WaitsForItsFirstPoint) {
  HandPath path({{0.002, 0.03}, {0.004, 0.05}}, 1000.0);
  path.next_tick();
  EXPECT_DOUBLE_EQ(path.position_m(), 0.03);
  EXPECT_DOUBLE_EQ(path.velocity_m_per_s(), 0.0);
  path.next_tick();
  path.next_tick();
  EXPECT_DOUBLE_EQ(path.position_m(), 0.04);
}

TEST(HandPath, BendsWhereAPointFallsBetweenTicks) {
  HandPath path({{0.0, 0.0}, {0.00125, 0.0125}, {0.00175, 0.0}}, 1000.0);
  EXPECT_FALSE(path.bends_within_tick());
  path.next_tick();
  ASSERT_TRUE(path.bends_within_tick());
  EXPECT_DOUBLE_EQ(path.position_m(), 0.01);
  EXPECT_DOUBLE_EQ(path.piece_fraction(), 0.25);
  ASSERT_TRUE(path.next_piece());
  EXPECT_DOUBLE_EQ(path.position_m(), 0.0125);
  EXPECT_DOUBLE_EQ(path.velocity_m_per_s(), -25.0);
  EXPECT_DOUBLE_EQ(path.piece_fraction(), 0.5);
  ASSERT_TRUE(path.next_piece());
  EXPECT_DOUBLE_EQ(path.position_m(), 0.0);
  EXPECT_DOUBLE_EQ(path.piece_fraction(), 0.25);
  EXPECT_FALSE(path.next_piece());
  path.next_tick();
  EXPECT_FALSE(path.bends_within_tick());
  EXPECT_DOUBLE_EQ(path.position_m(), 0.0);
}

// A piece may begin on the segment of a script that began earlier, and between two ticks.
TEST(HandPath, FollowsARecordedHandPieceByPiece) {
  SharedPath recorded;
  recorded.recorded =
      std::make_shared<const RecordedPieces>(RecordedPieces{1000.0,
                                                            {{0.0, 0.0, 0.03, 0.0},
                                                             {2.0, 2.0, 0.03, 0.5},
                                                             {3.0, 1.5, 0.04, 0.1},
                                                             {4.5, 4.5, 0.05, 0.0}}});
  EXPECT_FALSE(recorded.empty());
  HandPath path(recorded, 1000.0);
  for (const double position_m : {0.03, 0.03, 0.03, 0.04 + 0.1 * 1.5e-3, 0.04 + 0.1 * 2.5e-3}) {
    EXPECT_DOUBLE_EQ(path.position_m(), position_m);
    EXPECT_EQ(path.bends_within_tick(), position_m > 0.0402);
    if (!path.bends_within_tick()) path.next_tick();
  }
  ASSERT_TRUE(path.next_piece());
  EXPECT_DOUBLE_EQ(path.position_m(), 0.05);
  EXPECT_DOUBLE_EQ(path.velocity_m_per_s(), 0.0);
  path.reset();
  EXPECT_DOUBLE_EQ(path.position_m(), 0.03);
}

TEST(HandPath, FollowsThePointerAsFastAsAnArm) {
  HandPath path({{0.0, 0.03}}, 1000.0);
  path.lead_to(0.0325);
  EXPECT_DOUBLE_EQ(path.position_m(), 0.03);
  EXPECT_NEAR(path.velocity_m_per_s(), kMaxPointerSpeedMPerS, 1e-12);
  path.next_tick();
  path.next_tick();
  EXPECT_NEAR(path.position_m(), 0.032, 1e-15);
  path.next_tick();
  EXPECT_NEAR(path.position_m(), 0.0325, 1e-15);
  path.next_tick();
  EXPECT_DOUBLE_EQ(path.velocity_m_per_s(), 0.0);
  path.release();
  EXPECT_LT(path.velocity_m_per_s(), 0.0);
  for (int i = 0; i < 5; ++i) path.next_tick();
  EXPECT_DOUBLE_EQ(path.position_m(), 0.03);
}

// A hand of `path = "mouse"` has no script: it starts where the handle does.
TEST(HandPath, WithoutAScriptFollowsThePointerJustAsFast) {
  HandPath path(0.03, 1000.0);
  path.lead_to(0.0325);
  EXPECT_NEAR(path.velocity_m_per_s(), kMaxPointerSpeedMPerS, 1e-12);
  path.next_tick();
  EXPECT_NEAR(path.position_m(), 0.031, 1e-15);
  path.next_tick();
  path.next_tick();
  EXPECT_NEAR(path.position_m(), 0.0325, 1e-15);
}

TEST(HandPath, ReleasedReturnsToWhereTheScriptIsByThen) {
  HandPath path({{0.0, 0.03}, {0.1, 0.04}}, 1000.0);
  path.lead_to(0.02);
  for (int i = 0; i < 50; ++i) path.next_tick();
  path.release();
  for (int i = 0; i < 40; ++i) path.next_tick();
  EXPECT_NEAR(path.position_m(), 0.03 + 0.1 * 0.09, 1e-15);
  EXPECT_NEAR(path.velocity_m_per_s(), 0.1, 1e-12);
}

TEST(HandPath, ResetGoesBackToTheBeginOfTheScriptAndLeavesThePointer) {
  HandPath path({{0.0, 0.03}, {0.002, 0.05}, {0.004, 0.03}}, 1000.0);
  for (int i = 0; i < 10; ++i) path.next_tick();
  path.lead_to(0.0);
  path.reset();
  for (const double expected_m : {0.03, 0.04, 0.05, 0.04, 0.03, 0.03}) {
    EXPECT_NEAR(path.position_m(), expected_m, 1e-15);
    path.next_tick();
  }
}

// 0.3 s at 7 kHz is tick 2099.9999999999998 in binary: a bend there would be rounding, not script.
TEST(HandPath, TakesADecimalTimeForTheTickThatItMeans) {
  for (const double rate_hz : {700.0, 1000.0, 1700.0, 3300.0, 7000.0}) {
    for (int tenths = 1; tenths <= 30; ++tenths) {
      HandPath path({{0.0, 0.0}, {0.1 * tenths, 0.5}}, rate_hz);
      const int ticks = static_cast<int>(rate_hz) * tenths / 10;
      for (int tick = 0; tick <= ticks; ++tick) {
        ASSERT_FALSE(path.bends_within_tick()) << rate_hz << " Hz, tick " << tick;
        path.next_tick();
      }
    }
  }
}

}  // namespace
}  // namespace hapticwall
