// F5 shows the first window alone and large, whatever was shown before.
#include "app/ui/first/presentation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "app/ui/window/settings_file.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using ::testing::HasSubstr;

class PresentationTest : public GuiTest {
 protected:
  PresentationTest() { shows_everything = false; }

  void resize(float width, float height, int percent) {
    ImGui::GetIO().DisplaySize = ImVec2(width, height);
    state().appearance.scale_percent = percent;
    frames(4);
  }
  [[nodiscard]] bool presents() const { return state().window.presents; }
  static float height_of(const std::string& item) { return rect(item).to.y - rect(item).from.y; }
};

TEST_F(PresentationTest, ShowsTwoWallsTwoPlotsAndKeysAndNothingElse) {
  click("begin tour");
  live(4000);
  for (const char* item : {"pause", "more", "help", "tour next", "The hold has fed the hand…"})
    EXPECT_TRUE(sees(item)) << item;
  press(ImGuiKey_F5);
  live(4000);
  ASSERT_TRUE(presents());
  for (const char* item : {"oscillating", "settled", "no algorithm", "energy bounding", "wall view",
                           "contact ×10", "runs Position", "runs Force", "none", "half-sample"})
    EXPECT_TRUE(sees(item)) << item;
  for (const char* item : {"pause", "reset", "begin tour", "more", "help", "tour next",
                           "keys act here", "F1…", "The hold has fed the hand…"})
    EXPECT_FALSE(sees(item)) << item;
  press(ImGuiKey_F5);
  EXPECT_FALSE(presents());
  EXPECT_TRUE(sees("tour next")) << "the tour goes on";
}

TEST_F(PresentationTest, IsFoundAfterMoreAndEscLeavesItThere) {
  state().window.more = true;
  frames(4);
  ASSERT_TRUE(sees("page Map"));
  press(ImGuiKey_F5);
  EXPECT_FALSE(sees("page Map"));
  EXPECT_TRUE(sees("runs Force"));
  press(ImGuiKey_F1);
  press(ImGuiKey_Escape);
  EXPECT_TRUE(presents()) << "the help was put away";
  press(ImGuiKey_Escape);
  frames(3);
  EXPECT_FALSE(presents());
  EXPECT_TRUE(sees("page Map"));
}

TEST_F(PresentationTest, TheVerdictGrowsWithTheWindowAndIsNeverCut) {
  for (const auto& [width, height, percent, verdict_px] :
       {std::tuple{1000.0F, 680.0F, 100, 40.0F}, std::tuple{1280.0F, 800.0F, 100, 47.0F},
        std::tuple{1024.0F, 680.0F, 200, 40.0F}, std::tuple{1920.0F, 1080.0F, 100, 63.0F},
        std::tuple{3840.0F, 2160.0F, 200, 127.0F}}) {
    SCOPED_TRACE(fmt::format("{} x {} at {} %", width, height, percent));
    resize(width, height, percent);
    live(3000);
    const float usual = height_of("oscillating");
    press(ImGuiKey_F5);
    frames(3);
    const float ratio = height_of("oscillating") / verdict_px;
    EXPECT_GT(ratio, 0.95F);
    EXPECT_LT(ratio, 1.5F) << "of a line and its text";
    if (percent == 100) EXPECT_GT(height_of("oscillating"), usual);
    expect_within(width);
    EXPECT_LT(rect("30 kN/m").to.x, rect("oscillating").from.x) << "inside of its card";
    EXPECT_LT(rect("2.8 mm at 50 Hz").to.x, width - 16.0F);
    EXPECT_LE(rect("half-sample").to.y, height);
    EXPECT_GE(height_of("runs Force"), 90.0F);
    EXPECT_GT(height_of("half-sample"), 0.04F * height) << "large keys";
    press(ImGuiKey_F5);
    EXPECT_FLOAT_EQ(ImGui::GetStyle().FontScaleMain, static_cast<float>(percent) / 100.0F);
  }
}

TEST_F(PresentationTest, ItsKeysAndCardsWork) {
  live(2000);
  press(ImGuiKey_F5);
  click("virtual-coupling");
  EXPECT_EQ(scene().algorithm.index, 1U);
  live(500);
  click("lead B");
  EXPECT_EQ(scene().algorithm.index, 0U) << "that of the other card";
  EXPECT_TRUE(presents());
}

TEST_F(PresentationTest, WithoutTwoWallsAMessageSaysWhyNot) {
  const auto expect_refused = [&](const char* why) {
    state().toasts.clear();
    press(ImGuiKey_F5);
    EXPECT_FALSE(presents()) << why;
    EXPECT_THAT(message().text, HasSubstr(why));
  };
  open("corner");
  expect_refused("one axis");
  with_device = true;
  open("press");
  expect_refused("a device has one");
  with_device = false;
  open("press");
  start_trials(2);
  expect_refused("blind test");
}

TEST_F(PresentationTest, EndsWhenTheSessionHasOneWall) {
  press(ImGuiKey_F5);
  ASSERT_TRUE(presents());
  start_trials(2);
  EXPECT_FALSE(presents());
}

TEST_F(PresentationTest, ALayoutOrTheTourLeavesIt) {
  press(ImGuiKey_F5);
  press(ImGuiKey_F3);
  EXPECT_FALSE(presents());
  EXPECT_TRUE(sees("layout"));
  press(ImGuiKey_F5);
  press(ImGuiKey_F1);
  click("tour of help");
  EXPECT_FALSE(presents());
  EXPECT_TRUE(sees("tour next"));
}

TEST_F(PresentationTest, IsNotKept) {
  options.settings_path = path("settings.json");
  open("press");
  press(ImGuiKey_F5);
  application_->save_settings();
  EXPECT_EQ(text_of(path("settings.json")).find("present"), std::string::npos);
  open("press");
  EXPECT_FALSE(presents());
}

TEST_F(PresentationTest, TheFormerLayoutForARoomIsReadWithoutAComplaint) {
  put("settings.json",
      R"json({"window": {"more": true, "layout": "lecture", "docked": "Y40%(Wall;Plots)"}})json");
  options.settings_path = path("settings.json");
  open("press");
  EXPECT_EQ(message().text, "");
  EXPECT_EQ(state().dock.layout, "bench");
  EXPECT_TRUE(sees("page Map"));
}

}  // namespace
}  // namespace hapticwall::test
