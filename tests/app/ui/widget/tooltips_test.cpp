// Tooltips of the window leave the row free that one wants to click next.
#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "app/ui/panel/layout_choice.h"
#include "app/ui/state/tour.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

class TooltipsTest : public GuiTest {
 protected:
  // The place of the tooltip while the pointer rests on the item.
  std::optional<ItemRect> tooltip_of(const std::string& item) {
    move_away();
    move_to(rect(item).centre());
    frames(90);
    const ImGuiWindow* tooltip = ImGui::FindWindowByName("##Tooltip_00");
    if (tooltip == nullptr || !tooltip->Active) return std::nullopt;
    const ImVec2 end(tooltip->Pos.x + tooltip->Size.x, tooltip->Pos.y + tooltip->Size.y);
    return ItemRect{tooltip->Pos, end};
  }

  // Checks those items below this one that are within the next row, if that is near.
  void expect_next_row_free(const std::string& name) {
    const auto tooltip = tooltip_of(name);
    ASSERT_TRUE(tooltip) << name << " has no tooltip";
    const ItemRect item = rect(name);
    float next = item.to.y + 1.5F * ImGui::GetFrameHeight();
    for (const auto& [other, place] : drawn_items())
      if (is_control(other, place) && place.from.y >= item.to.y)
        next = std::min(next, place.from.y);
    for (const auto& [other, place] : drawn_items()) {
      const bool in_row = place.from.y >= item.to.y && place.from.y < next + 1.0F;
      if (is_control(other, place) && in_row)
        EXPECT_FALSE(tooltip->meets(place)) << name << " covers " << other;
    }
    EXPECT_FALSE(tooltip->meets(item)) << name;
  }

 private:
  static bool is_control(const std::string& name, const ItemRect& place) {
    const bool picture = name == "wall view" || name == "magnifier" ||
                         name.starts_with("map cells") || name.starts_with("gap ");
    return place.id != 0 && !picture;
  }
};

TEST_F(TooltipsTest, OfTheToolbar) {
  for (const char* name : {"pause", "record", "sound", "slow motion", "repeat scene"})
    expect_next_row_free(name);
}

TEST_F(TooltipsTest, OfTheMapPage) {
  click("page Map");
  frames(3);
  for (const char* name : {"map algorithms", "map number 0", "map from 0", "map log 0",
                           "map around 0", "map number 1"})
    expect_next_row_free(name);
}

// In every layout the tooltip of a tab leaves the page free, and the tab.
TEST_F(TooltipsTest, OfTheTabs) {
  for (const char* layout : {"bench", "experiment"}) {
    choose_layout(state().dock, state().window, state().plots, layout);
    frames(5);
    for (const auto& [name, tab] : drawn_items()) {
      if (!name.starts_with("page ") || tab.id == 0) continue;
      SCOPED_TRACE(name);
      const auto tooltip = tooltip_of(name);
      ASSERT_TRUE(tooltip);
      EXPECT_FALSE(tooltip->meets(tab)) << tooltip->from.y << " to " << tooltip->to.y << ", tab "
                                        << tab.from.y << " to " << tab.to.y;
      const ItemRect page{ImVec2(tab.from.x, tab.to.y),
                          ImVec2(tab.to.x, tab.to.y + 8.0F * ImGui::GetFrameHeight())};
      EXPECT_FALSE(tooltip->meets(page)) << "its first fields";
    }
  }
}

TEST_F(TooltipsTest, OfTheTour) {
  state().tour.offered = true;
  frames(2);
  for (const char* name : {"begin tour", "close tour"}) expect_next_row_free(name);
}

}  // namespace
}  // namespace hapticwall::test
