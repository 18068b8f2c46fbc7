#include "app/draw/axis/dashes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace hapticwall::draw {
namespace {

constexpr float kClosePixels = 0.21F;  // the promise and a rounding error
const float kGap = std::numeric_limits<float>::quiet_NaN();

std::vector<ImVec2> bends(std::vector<ImVec2> points) {
  keep_bends(points);
  return points;
}

float distance(ImVec2 point, ImVec2 from, ImVec2 to) {
  const ImVec2 way(to.x - from.x, to.y - from.y);
  const float squared = way.x * way.x + way.y * way.y;
  const float along = ((point.x - from.x) * way.x + (point.y - from.y) * way.y) / squared;
  const float share = squared > 0.0F ? std::clamp(along, 0.0F, 1.0F) : 0.0F;
  return std::hypot(from.x + share * way.x - point.x, from.y + share * way.y - point.y);
}

TEST(KeepBendsTest, AStraightLineKeepsItsEndsAndAStrokeItsTurn) {
  EXPECT_EQ(bends({{0, 5}, {1, 5}, {2, 5}, {3, 5}}).size(), 2U);
  EXPECT_EQ(bends({{0, 0}, {1, 2}, {2, 4}, {9, 18}}).size(), 2U);
  const std::vector<ImVec2> back = bends({{0, 0}, {0, 9}, {0, 20}, {0, 4}, {1, 4}});
  ASSERT_EQ(back.size(), 4U);
  EXPECT_EQ(back[1].y, 20.0F);
  EXPECT_EQ(back[2].y, 4.0F);
}

TEST(KeepBendsTest, AGapStaysWithBothItsShores) {
  const std::vector<ImVec2> kept =
      bends({{0, 0}, {1, 0}, {2, 0}, {3, kGap}, {4, 7}, {5, 7}, {6, 7}});
  ASSERT_EQ(kept.size(), 5U);
  EXPECT_EQ(kept[1].x, 2.0F);
  EXPECT_TRUE(std::isnan(kept[2].y));
  EXPECT_EQ(kept[3].x, 4.0F);
  EXPECT_TRUE(bends({}).empty());
}

// Lines that creep, walk and jump.
TEST(KeepBendsTest, NoDroppedPointIsFarFromTheLine) {
  std::mt19937 random(20261123);
  std::normal_distribution<float> step;
  std::size_t dropped = 0;
  for (int line = 0; line < 300; ++line) {
    const float size = std::pow(10.0F, static_cast<float>(line % 5) - 3.0F);
    std::vector<ImVec2> points{{0, 0}};
    for (int i = 1; i < 400; ++i)
      points.emplace_back(0.7F * std::floor(static_cast<float>(i) / 2.0F),
                          points.back().y + size * step(random));
    const std::vector<ImVec2> kept = bends(points);
    ASSERT_EQ(kept.front().y, points.front().y);
    ASSERT_EQ(kept.back().y, points.back().y);
    std::size_t next = 1;  // kept[next] is the first kept one not before the point
    for (const ImVec2& point : points) {
      if (point.x == kept[next].x && point.y == kept[next].y && next + 1 < kept.size()) ++next;
      const float before = distance(point, kept[next - 1], kept[next]);
      const float after = next > 1 ? distance(point, kept[next - 2], kept[next - 1]) : before;
      ASSERT_LE(std::min(before, after), kClosePixels) << "line " << line;
    }
    dropped += points.size() - kept.size();
  }
  EXPECT_GT(dropped, 30'000U);
}

}  // namespace
}  // namespace hapticwall::draw
