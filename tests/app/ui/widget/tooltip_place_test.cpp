#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "app/ui/widget/widgets.h"

namespace hapticwall::ui {
namespace {

constexpr ImVec2 kScreen(1000.0F, 640.0F);
constexpr float kRow = 24.0F;

bool overlap(ImVec2 from, ImVec2 size, ImVec2 other_from, ImVec2 other_to) {
  return from.x < other_to.x && other_from.x < from.x + size.x && from.y < other_to.y &&
         other_from.y < from.y + size.y;
}

TEST(TooltipPlace, IsBesideANarrowPanel) {
  const TooltipSpace space{{20.0F, 300.0F},  {80.0F, 320.0F}, {8.0F, 8.0F},
                           {330.0F, 600.0F}, kScreen,         kRow};
  const ImVec2 place = tooltip_place(space, ImVec2(350.0F, 120.0F));
  EXPECT_GT(place.x, space.window_to.x);
  EXPECT_EQ(place.y, space.item_from.y);
}

// In windows of any size, the row of the item and the next one stay free, and the tooltip is on the
// screen.
TEST(TooltipPlace, NeverCoversTheRowThatOneWantsNext) {
  std::mt19937 random(7);
  const auto between = [&](float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random);
  };
  for (int round = 0; round < 20000; ++round) {
    TooltipSpace space{{}, {}, {}, {}, kScreen, kRow};
    space.window_from = {between(0.0F, 700.0F), between(0.0F, 300.0F)};
    space.window_to = {between(space.window_from.x + 100.0F, kScreen.x),
                       between(space.window_from.y + 2.0F * kRow, kScreen.y)};
    space.item_from = {between(space.window_from.x, space.window_to.x - 20.0F),
                       between(space.window_from.y, space.window_to.y - kRow)};
    space.item_to = {space.item_from.x + 20.0F, space.item_from.y + kRow};
    const ImVec2 size(between(50.0F, 420.0F), between(20.0F, 200.0F));
    const ImVec2 place = tooltip_place(space, size);
    const ImVec2 from(space.window_from.x, space.item_from.y);
    const ImVec2 to(space.window_to.x, space.item_to.y + kRow);
    ASSERT_FALSE(overlap(place, size, from, to)) << round;
    ASSERT_GE(std::min(place.x, place.y), 0.0F);
    ASSERT_LE(place.x + size.x, kScreen.x + 1e-3F);
    ASSERT_LE(place.y + size.y, kScreen.y + 1e-3F);
  }
}

// A tab at any place of a window of any size: its tooltip covers neither the tab nor the first
// third of the page, where the window leaves room.
TEST(TooltipPlace, OfATabLeavesThePageFree) {
  std::mt19937 random(11);
  const auto between = [&](float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random);
  };
  for (int round = 0; round < 20000; ++round) {
    TooltipSpace space{{}, {}, {}, {}, kScreen, kRow};
    space.window_from = {between(0.0F, 700.0F), between(0.0F, 300.0F)};
    space.window_to = {between(space.window_from.x + 100.0F, kScreen.x),
                       between(space.window_from.y + 12.0F * kRow, kScreen.y)};
    space.item_from = {between(space.window_from.x, space.window_to.x - 20.0F),
                       space.window_from.y};
    space.item_to = {space.item_from.x + 20.0F, space.item_from.y + kRow};
    const ImVec2 size(between(50.0F, 390.0F), between(20.0F, 80.0F));
    const ImVec2 place = tab_tooltip_place(space, size);
    const ImVec2 to(space.window_to.x, space.item_to.y + 6.0F * kRow);
    ASSERT_FALSE(overlap(place, size, space.window_from, to)) << round;
    ASSERT_GE(std::min(place.x, place.y), 0.0F);
    ASSERT_LE(place.x + size.x, kScreen.x + 1e-3F);
    ASSERT_LE(place.y + size.y, kScreen.y + 1e-3F);
  }
}

}  // namespace
}  // namespace hapticwall::ui
