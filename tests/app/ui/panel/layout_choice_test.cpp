// Layouts of one's own: names, keeping, choosing and deleting.
#include "app/ui/panel/layout_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using ::testing::HasSubstr;
using ui::keep_layout;

class LayoutChoiceTest : public GuiTest {
 protected:
  void keep_as(const std::string& name) {
    click("layout");
    type("layout name", name);
    frames(2);
  }
  [[nodiscard]] const ui::DockState& kept() const { return state().dock; }
  [[nodiscard]] std::string chosen() const { return ui::layout_text(*state().dock.chosen); }
};

TEST_F(LayoutChoiceTest, EveryBuiltinTextIsReadAndNamesWindowsThatAreThere) {
  for (const ui::BuiltinLayout& layout : ui::builtin_layouts()) {
    const auto read = ui::parse_layout(layout.text);
    ASSERT_TRUE(read.has_value()) << layout.name;
    for (const std::string& window : windows_of(*read)) {
      EXPECT_TRUE(std::ranges::any_of(state().dock.windows, [&](const auto& each) {
        return each.name == window;
      })) << window;
    }
    EXPECT_NE(std::string(layout.meaning), "");
  }
  EXPECT_TRUE(ui::parse_layout(ui::kFirstMinute));
}

TEST_F(LayoutChoiceTest, OnesOwnIsKeptChosenReplacedAndDeleted) {
  options.settings_path = path("settings.json");
  open("press");
  drag_by("gap 0", ImVec2(50.0F, 0.0F));
  click("page Timing");
  const std::string evening = chosen();
  keep_as("  evening ");
  EXPECT_EQ(kept().layout, "evening");
  choose_layout(state().dock, state().window, state().plots, "bench");
  frames(5);
  EXPECT_NE(chosen(), evening);
  application_->save_settings();
  open("press");
  press(ImGuiKey_Escape);
  click("layout");
  click("layout of evening");
  frames(5);
  EXPECT_EQ(chosen(), evening);
  EXPECT_TRUE(sees("timing clear"));
  click("page Plots");
  EXPECT_FALSE(keep_layout(state().dock, "evening")) << "replaces it";
  ASSERT_EQ(kept().own_layouts.size(), 1U);
  EXPECT_NE(ui::layout_text(kept().own_layouts.front().layout), evening);
  const std::string last = chosen();
  click("layout");
  click("forget layout");
  EXPECT_TRUE(kept().own_layouts.empty());
  EXPECT_EQ(kept().layout, "bench");
  EXPECT_EQ(chosen(), last) << "the windows stay";
  EXPECT_EQ(kept().docked, last);
}

TEST_F(LayoutChoiceTest, AWrongNameIsRefusedBelowItsField) {
  for (const auto& [name, why] :
       {std::pair{"bench", "'bench' is a built-in layout"}, std::pair{"   ", "needs a name"},
        std::pair{"0123456789012345678901234567890123456789x", "at most 40 bytes"}}) {
    keep_as(name);
    ASSERT_TRUE(refusal().has_value()) << name;
    EXPECT_THAT(refusal()->why, HasSubstr(why));
    EXPECT_TRUE(sees(refusal()->why)) << name;
    press(ImGuiKey_Escape);
    state().edit.refusal.reset();
  }
  for (const char* name : {"two\nlines", "\xff", "\x1b[2J", "a\xc2\x85"})
    EXPECT_THAT(keep_layout(state().dock, name).value_or(""), HasSubstr("no control characters"));
  EXPECT_TRUE(kept().own_layouts.empty());
  for (std::size_t i = 0; i < ui::kMaxOwnLayouts; ++i)
    EXPECT_FALSE(keep_layout(state().dock, "number " + std::to_string(i)));
  EXPECT_THAT(keep_layout(state().dock, "one more").value_or(""), HasSubstr("delete one"));
  EXPECT_FALSE(keep_layout(state().dock, "number 3")) << "an old name is free";
}

TEST_F(LayoutChoiceTest, F3GoesThroughAllAndOpensMore) {
  EXPECT_FALSE(keep_layout(state().dock, "mine"));
  state().window.more = false;
  frames(3);
  press(ImGuiKey_F3);
  EXPECT_TRUE(state().window.more);
  for (const ui::BuiltinLayout& layout : ui::builtin_layouts()) {
    EXPECT_EQ(kept().layout, layout.name);
    press(ImGuiKey_F3);
  }
  EXPECT_EQ(kept().layout, "mine");
}

}  // namespace
}  // namespace hapticwall::test
