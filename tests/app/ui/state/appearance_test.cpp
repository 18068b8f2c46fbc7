// Colours, scale and the sizes of the parts of the window.
#include "app/ui/state/appearance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using draw::Look;
using draw::Tone;

// Relative luminance and contrast as the Web Content Accessibility Guidelines (2.1) define them.
double luminance(const ImVec4& colour) {
  const auto linear = [](float channel) {
    const auto value = static_cast<double>(channel);
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(colour.x) + 0.7152 * linear(colour.y) + 0.0722 * linear(colour.z);
}

double contrast(const ImVec4& a, const ImVec4& b) {
  const double first = luminance(a);
  const double second = luminance(b);
  return (std::max(first, second) + 0.05) / (std::min(first, second) + 0.05);
}

ImVec4 over(const ImVec4& top, float alpha, const ImVec4& below) {
  const auto mix = [alpha](float a, float b) { return alpha * a + (1.0F - alpha) * b; };
  return {mix(top.x, below.x), mix(top.y, below.y), mix(top.z, below.z), 1.0F};
}

const ImVec4& colour(Look look, Tone tone) {
  return draw::theme_colours(look).at(static_cast<std::size_t>(tone));
}

TEST(Contrast, IsThatOfTheGuidelines) {
  const ImVec4 black(0.0F, 0.0F, 0.0F, 1.0F);
  const ImVec4 white(1.0F, 1.0F, 1.0F, 1.0F);
  const ImVec4 grey(0x76 / 255.0F, 0x76 / 255.0F, 0x76 / 255.0F, 1.0F);
  EXPECT_NEAR(contrast(black, white), 21.0, 1e-9);
  EXPECT_NEAR(contrast(grey, white), 4.54, 0.01);  // the lightest grey that passes
}

class ThemeOf : public ::testing::TestWithParam<Look> {};

TEST_P(ThemeOf, TextIsReadableOnEveryBackground) {
  constexpr double kEnough = 4.5;
  for (const Tone ground : {Tone::kPanel, Tone::kBackground}) {
    for (const Tone text : {Tone::kText, Tone::kMuted, Tone::kAccent, Tone::kGood, Tone::kWarning,
                            Tone::kBad, Tone::kHand, Tone::kForce, Tone::kPosition}) {
      EXPECT_GE(contrast(colour(GetParam(), text), colour(GetParam(), ground)), kEnough)
          << "tone " << static_cast<int>(text) << " on " << static_cast<int>(ground);
    }
  }
  // Buttons, fields and selected items, also under the pointer.
  const ImVec4& text = colour(GetParam(), Tone::kText);
  const ImVec4& panel = colour(GetParam(), Tone::kPanel);
  EXPECT_GE(contrast(text, colour(GetParam(), Tone::kFaint)), kEnough);
  for (const float alpha : {0.22F, 0.30F, 0.35F, 0.42F})
    EXPECT_GE(contrast(text, over(colour(GetParam(), Tone::kAccent), alpha, panel)), kEnough);
}

TEST_P(ThemeOf, LinesStandOutFromTheirPlot) {
  constexpr double kEnough = 3.0;  // graphical objects
  const ImVec4& plot = colour(GetParam(), Tone::kBackground);
  for (const Tone line :
       {Tone::kPosition, Tone::kHand, Tone::kForce, Tone::kWallForce, Tone::kStiffness,
        Tone::kObserver, Tone::kHold, Tone::kScv, Tone::kBudget, Tone::kWall}) {
    EXPECT_GE(contrast(colour(GetParam(), line), plot), kEnough)
        << "tone " << static_cast<int>(line);
  }
}

INSTANTIATE_TEST_SUITE_P(Screen, ThemeOf, ::testing::Values(Look::kScreen, Look::kLight));

TEST(Scale, TheCommandLineComesBeforeTheSettingsAndTheseBeforeTheScreen) {
  ui::Appearance state;
  EXPECT_EQ(ui::scale_in_force(state), 1.0F);
  state.screen_scale = 1.5F;
  EXPECT_EQ(ui::scale_in_force(state), 1.5F);
  ui::set_scale(state, 125);
  EXPECT_EQ(ui::scale_in_force(state), 1.25F);
  state.forced_scale = 2.0F;
  EXPECT_EQ(ui::scale_in_force(state), 2.0F);
  ui::step_scale(state, 1);
  EXPECT_EQ(ui::scale_percent_in_force(state), 210);
  EXPECT_FALSE(state.forced_scale.has_value());
  ui::set_scale(state, 125);
  ui::step_scale(state, -1);
  EXPECT_EQ(state.scale_percent, 120);
  ui::set_scale(state, 5000);
  EXPECT_EQ(state.scale_percent, session::kMaxScalePercent);
  ui::set_scale(state, 1);
  EXPECT_EQ(state.scale_percent, session::kMinScalePercent);
  ui::set_scale(state, 0);
  EXPECT_EQ(ui::scale_in_force(state), 1.5F);
}

class AppearanceTest : public GuiTest {
 protected:
  [[nodiscard]] ui::Appearance& kept() const { return state().appearance; }
};

TEST_F(AppearanceTest, BothLooksAreDrawnInTheirOwnColours) {
  // Its dots lie on the handle's line.
  state().plots.persisted.hidden_lines = draw::line_bit(&PlantTruth::position_m);
  live(4000);
  for (const Look look : {Look::kScreen, Look::kLight}) {
    kept().look = look;
    move_away();
    const file::Picture picture = screen();
    const auto count = [&](Tone tone, const ItemRect& area) {
      return count_tone(picture, tone, area, look);
    };
    constexpr int kEnoughPixels = 300;
    EXPECT_GT(count(Tone::kBackground, rect("plot Position")), kEnoughPixels);
    EXPECT_GT(count(Tone::kPosition, rect("plot Position")), 50);  // pixels that are not blended
    const ItemRect panel{ImVec2(20.0F, 20.0F), ImVec2(300.0F, 700.0F)};
    EXPECT_GT(count(Tone::kPanel, panel), kEnoughPixels);
    EXPECT_GT(count(Tone::kFaint, rect("scene")), kEnoughPixels);
  }
}

TEST_F(AppearanceTest, TheSizeFollowsTheScreenUnlessItIsChosen) {
  EXPECT_FLOAT_EQ(ImGui::GetStyle().FontScaleMain, 1.0F);
  application_->set_screen_scale(1.25F);
  frames(2);
  EXPECT_FLOAT_EQ(ImGui::GetStyle().FontScaleMain, 1.25F);
}

TEST_F(AppearanceTest, TwiceAsLargeIsTheSamePictureOfTwiceTheSize) {
  const Items places = drawn_items();
  kept().scale_percent = 200;
  ImGui::GetIO().DisplaySize = ImVec2(2.0F * kScreenWidth, 2.0F * kScreenHeight);
  frames(3);
  constexpr float kRounding = 6.0F;  // pixels, of many small parts
  for (const auto& [name, small] : places) {
    if (small.id == 0) continue;
    const auto large = find(name);
    ASSERT_TRUE(large.has_value()) << name;
    EXPECT_NEAR(large->from.x, 2.0F * small.from.x, kRounding) << name;
    EXPECT_NEAR(large->to.x, 2.0F * small.to.x, 2.0F * kRounding) << name;
  }
  expect_within(2.0F * kScreenWidth);
}

TEST_F(AppearanceTest, EverythingFitsFromHalfToOneAndAHalf) {
  live(1000);
  for (const int percent : {50, 75, 100, 125, 150}) {
    kept().scale_percent = percent;
    const ImVec2 size(static_cast<float>(kScreenWidth * percent) / 100.0F,
                      static_cast<float>(kScreenHeight * percent) / 100.0F);
    ImGui::GetIO().DisplaySize = size;
    frames(3);
    expect_within(size.x);
    if (percent != 100) continue;
    for (const auto& [name, item] : drawn_items()) {
      if (item.id == 0) continue;
      EXPECT_GE(item.from.y, 0.0F) << name;
      EXPECT_LE(item.to.y, size.y) << name;
    }
  }
}

TEST_F(AppearanceTest, TheCommandLinesScaleIsInForceAndNotKept) {
  options.forced_scale = 1.5F;
  open("press");
  EXPECT_FLOAT_EQ(ImGui::GetStyle().FontScaleMain, 1.5F);
  EXPECT_EQ(kept().scale_percent, 0);
}

}  // namespace
}  // namespace hapticwall::test
