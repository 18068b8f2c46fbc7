#include "app/ui/widget/overflow_row.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using ::testing::ElementsAre;

const std::vector<ui::RowControl> kRow{{100.0F, 1, {}}, {50.0F, 2, {}}, {80.0F, 0, {}}};

TEST(ControlsInRow, AllStayWhereAllFit) {
  EXPECT_THAT(ui::controls_in_row(kRow, 250.0F, 10.0F, 30.0F), ElementsAre(true, true, true));
}

TEST(ControlsInRow, TheRankDecidesWhichStayBesideTheButton) {
  EXPECT_THAT(ui::controls_in_row(kRow, 249.0F, 10.0F, 30.0F), ElementsAre(true, false, true));
  EXPECT_THAT(ui::controls_in_row(kRow, 229.0F, 10.0F, 30.0F), ElementsAre(false, true, true));
  EXPECT_THAT(ui::controls_in_row(kRow, 120.0F, 10.0F, 30.0F), ElementsAre(false, false, true));
  EXPECT_THAT(ui::controls_in_row(kRow, 0.0F, 10.0F, 30.0F), ElementsAre(false, false, false));
}

class OverflowRowTest : public GuiTest {
 protected:
  void make_wide(float width) {
    ImGui::GetIO().DisplaySize.x = width;
    frames(3);
  }
};

const std::set<std::string> kSession{"pause",          "step",  "reset",       "record",
                                     "recording name", "sound", "slow motion", "repeat scene"};

TEST_F(OverflowRowTest, EveryControlIsInTheRowOrInItsPopup) {
  for (const float width : {1280.0F, 1000.0F, 700.0F, 500.0F}) {
    make_wide(width);
    const float row = rect("pause").from.y;
    if (sees("more of session")) {
      EXPECT_EQ(rect("more of session").from.y, row);
      click("more of session");
    }
    for (const std::string& name : kSession) {
      EXPECT_LE(rect(name).to.x, width) << name;
      EXPECT_GE(rect(name).from.x, 0.0F) << name;
    }
    press(ImGuiKey_Escape);
  }
}

TEST_F(OverflowRowTest, AControlInThePopupWorks) {
  make_wide(620.0F);
  EXPECT_FALSE(sees("repeat scene"));
  click("more of session");
  click("repeat scene");
  EXPECT_TRUE(state().scene.repeats);
}

TEST_F(OverflowRowTest, NumbersMoveNoControl) {
  const auto places = [] {
    std::vector<float> all;
    for (const char* name : {"record", "sound", "slow motion", "repeat scene"})
      all.push_back(rect(name).from.x);
    return all;
  };
  const std::vector<float> before = places();
  fake_->advance(250'000);
  frames(2);
  EXPECT_EQ(places(), before);
}

TEST_F(OverflowRowTest, MOpensThePopupThatHoldsTheMark) {
  make_wide(700.0F);
  press(ImGuiMod_Ctrl | ImGuiKey_R);
  ASSERT_FALSE(sees("mark text"));
  press(ImGuiKey_M);
  frames(3);
  EXPECT_TRUE(sees("mark text"));
  EXPECT_TRUE(ImGui::GetIO().WantTextInput);
  EXPECT_EQ(fake_->marks().size(), 1U);
}

TEST_F(OverflowRowTest, ALowWindowHidesThePlotsWithoutAnError) {
  int errors = 0;
  ImGui::GetCurrentContext()->ErrorCallback = [](ImGuiContext*, void* count, const char*) {
    ++*static_cast<int*>(count);
  };
  ImGui::GetCurrentContext()->ErrorCallbackUserData = &errors;
  state().appearance.forced_scale = 2.0F;
  ImGui::GetIO().DisplaySize = ImVec2(500.0F, 320.0F);
  frames(3);
  EXPECT_EQ(errors, 0);
}

}  // namespace
}  // namespace hapticwall::test
