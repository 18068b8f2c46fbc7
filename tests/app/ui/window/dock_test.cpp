// The dock area: layouts, separators, floating windows, and which pages run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "app/ui/panel/layout_choice.h"
#include "app/ui/state/appearance.h"
#include "app/ui/state/blind_test.h"
#include "app/ui/window/dock_nodes.h"
#include "app/ui/window/window_layout.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using ::testing::HasSubstr;
using ::testing::UnorderedElementsAreArray;
using ui::layout_text;
using ui::parse_layout;

void add_fronts(std::vector<std::string>& fronts, const ui::DockPart& part) {
  if (!part.tabs.empty()) fronts.push_back(part.tabs.at(part.front));
  for (const ui::DockPart& each : part.parts) add_fronts(fronts, each);
}

// The windows that are not behind a tab.
std::vector<std::string> fronts_of(const ui::DockLayout& layout) {
  std::vector<std::string> fronts;
  add_fronts(fronts, layout.docked);
  for (const ui::FloatingPart& each : layout.floating) add_fronts(fronts, each.part);
  return fronts;
}

float text_size() { return ImGui::GetStyle().FontSizeBase * ImGui::GetStyle().FontScaleMain; }

const ImGuiWindow* window_of(const std::string& page) {
  return ImGui::FindWindowByName(ui::dock_window(page).c_str());
}

class DockTest : public GuiTest {
 protected:
  // Drawn in the last frame, and not behind a tab.
  [[nodiscard]] static std::vector<std::string> seen() {
    std::vector<std::string> names;
    for (const ui::Page& page : ui::pages()) {
      const ImGuiWindow* window = window_of(page.window.name);
      if (window != nullptr && window->WasActive && !window->Hidden)
        names.emplace_back(page.window.name);
    }
    return names;
  }
  [[nodiscard]] static ImRect area(const std::string& page) {
    const ImGuiWindow* window = window_of(page);
    EXPECT_NE(window, nullptr) << page;
    return window == nullptr ? ImRect() : window->Rect();
  }
  void choose(const std::string& layout) {
    choose_layout(state().dock, state().window, state().plots, layout);
    frames(5);
  }
  void show(const std::string& text) {
    choose("bench");
    dock().chosen = *parse_layout(text);
    dock().rebuild = true;
    frames(5);
  }
  void resize(float width, float height, int percent) {
    ImGui::GetIO().DisplaySize = ImVec2(width, height);
    ui::set_scale(state().appearance, percent);
    frames(5);
  }
  void expect_inside_and_apart(const std::vector<std::string>& names) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const ImRect whole(ImVec2(0.0F, 0.0F), screen);
    for (std::size_t i = 0; i < names.size(); ++i) {
      const ImRect own = area(names[i]);
      EXPECT_TRUE(whole.Contains(own)) << names[i] << " at " << screen.x;
      EXPECT_GT(own.GetWidth(), 100.0F) << names[i] << " at " << screen.x;
      EXPECT_GT(own.GetHeight(), 60.0F) << names[i] << " at " << screen.x;
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_FALSE(own.Overlaps(area(names[k]))) << names[i] << " and " << names[k];
    }
  }
  void drag_tab_to(const std::string& page, ImVec2 to) { drag(rect("page " + page).centre(), to); }
  [[nodiscard]] ui::DockState& dock() const { return state().dock; }
  [[nodiscard]] std::string chosen() const { return layout_text(*dock().chosen); }
};

TEST_F(DockTest, EveryLayoutShowsWhatItSaysAtEverySize) {
  for (const ui::BuiltinLayout& layout : ui::builtin_layouts()) {
    SCOPED_TRACE(layout.name);
    choose(layout.name);
    const auto expected = fronts_of(*parse_layout(layout.text));
    if (layout.arrangement) EXPECT_EQ(state().plots.persisted.arrangement, *layout.arrangement);
    for (const auto& [width, height, percent] :
         {std::tuple{1000.0F, 640.0F, 100}, std::tuple{1280.0F, 800.0F, 100},
          std::tuple{1600.0F, 1000.0F, 100}, std::tuple{2000.0F, 1280.0F, 200}}) {
      resize(width, height, percent);
      EXPECT_THAT(seen(), UnorderedElementsAreArray(expected));
      expect_inside_and_apart(expected);
      EXPECT_EQ(windows_of(*dock().chosen), windows_of(*parse_layout(layout.text)));
      EXPECT_EQ(state().dock.docked, "") << "the user has moved nothing";
      EXPECT_TRUE(sees("layout")) << "another one can be chosen";
    }
    resize(1280.0F, 800.0F, 100);
  }
}

TEST_F(DockTest, TheFirstWindowHasNoPagesAndLeavesTheLayoutAlone) {
  choose("experiment");
  state().window.more = false;
  frames(4);
  EXPECT_TRUE(seen().empty());
  for (const auto& [name, item] : drawn_items())
    EXPECT_FALSE(name.starts_with("page ") && item.id != 0) << name;
  EXPECT_FALSE(sees("layout"));
  EXPECT_TRUE(sees("more"));
  state().window.more = true;
  frames(4);
  EXPECT_EQ(chosen(), layout_text(*parse_layout("X21.5em(Controls;Y45%(Wall;Blind test))")));
}

TEST_F(DockTest, AGapFollowsThePointerAndNoPartIsDraggedOutOfSight) {
  const float right = area("Controls").Max.x;
  drag_by("gap 0", ImVec2(60.0F, 0.0F));
  EXPECT_NEAR(area("Controls").Max.x, right + 60.0F, 2.0F);
  EXPECT_NEAR(parse_layout(state().dock.docked)->docked.ems, 21.5 + 60.0 / 15.0, 0.4);
  const float bottom = area("Wall").Max.y;
  drag_by("gap 1", ImVec2(0.0F, 40.0F));
  EXPECT_NEAR(area("Wall").Max.y, bottom + 40.0F, 2.0F);
  drag_by("gap 0", ImVec2(3000.0F, 0.0F));
  drag_by("gap 1", ImVec2(0.0F, -3000.0F));
  expect_inside_and_apart({"Controls", "Wall", "Contact", "Plots"});
}

TEST_F(DockTest, TheControlsKeepTheirWidthInTextSizes) {
  for (const auto& [width, percent] : {std::pair{1280.0F, 100}, std::pair{1600.0F, 100},
                                       std::pair{1600.0F, 150}, std::pair{1010.0F, 100}}) {
    resize(width, 900.0F, percent);
    EXPECT_NEAR(area("Controls").GetWidth() / text_size(), 21.5F, 0.1F) << width;
  }
  resize(1000.0F, 640.0F, 200);
  EXPECT_LE(area("Controls").GetWidth(), 500.0F) << "at most half of the window";
  resize(1280.0F, 800.0F, 100);
  EXPECT_NEAR(area("Controls").GetWidth() / text_size(), 21.5F, 0.1F) << "not forgotten";
}

TEST_F(DockTest, ATabIsDraggedOutStaysInsideAndComesBackWithItsLayout) {
  drag_tab_to("Timing", rect("wall view").at(0.25F, 0.3F));
  frames(5);
  ASSERT_EQ(dock().chosen->floating.size(), 1U) << chosen();
  EXPECT_EQ(dock().chosen->floating.front().part.tabs, std::vector<std::string>{"Timing"});
  EXPECT_THAT(seen(), ::testing::Contains("Timing"));
  for (const auto& [width, height, percent] :
       {std::tuple{1000.0F, 640.0F, 100}, std::tuple{1000.0F, 640.0F, 200}}) {
    resize(width, height, percent);
    const ImRect timing = area("Timing");
    EXPECT_TRUE(ImRect(0.0F, 0.0F, width, height).Contains(timing)) << percent;
  }
  resize(1280.0F, 800.0F, 100);
  const ui::DockLayout floating = *dock().chosen;
  choose("bench");
  EXPECT_TRUE(dock().chosen->floating.empty());
  dock().chosen = floating;
  dock().rebuild = true;
  frames(5);
  EXPECT_EQ(dock().chosen->floating.size(), 1U);
}

TEST_F(DockTest, WindowsThatFloatTogetherComeBackTogether) {
  show("Y40%(Wall;Plots)+X40%(Map;Timing*,Contact)@20%,20%,50%,40%");
  EXPECT_THAT(seen(), UnorderedElementsAreArray({"Wall", "Plots", "Map", "Timing"}));
  ASSERT_EQ(dock().measured.floating.size(), 1U);
  const ui::FloatingPart& group = dock().measured.floating.front();
  EXPECT_EQ(group.part.split, ui::DockSplit::kColumns);
  EXPECT_NEAR(group.part.share, 0.4, 0.01);
  EXPECT_NEAR(group.place.x, 0.2, 0.01);
  EXPECT_NEAR(group.place.height, 0.4, 0.01);
  resize(1000.0F, 640.0F, 200);
  EXPECT_TRUE(ImRect(0.0F, 0.0F, 1000.0F, 640.0F).Contains(area("Map")));
}

TEST_F(DockTest, TheMiddleButtonClosesATabAndTheListBringsItBack) {
  move_to(rect("page Map").centre());
  mouse_button(true, ImGuiMouseButton_Middle);
  mouse_button(false, ImGuiMouseButton_Middle);
  frames(4);
  EXPECT_FALSE(sees("page Map"));
  EXPECT_THAT(state().dock.docked, ::testing::Not(HasSubstr("Map")));
  click("layout");
  click("window Map");
  frames(4);
  EXPECT_THAT(seen(), ::testing::Contains("Map"));
}

TEST_F(DockTest, WithEveryWindowClosedTheLayoutIsStillChosen) {
  show("");
  EXPECT_TRUE(seen().empty());
  click("layout");
  click("layout of bench");
  frames(5);
  EXPECT_THAT(seen(), ::testing::Contains("Plots"));
}

TEST_F(DockTest, APageBehindATabDoesNotRun) {
  EXPECT_FALSE(state().timing.page_seen);
  EXPECT_FALSE(state().map.live.running());
  click("page Map");
  frames(2);
  EXPECT_FALSE(sees("plot Position"));
  EXPECT_TRUE(state().map.live.running() || state().map.live.up_to_date());
  click("page Timing");
  EXPECT_TRUE(state().timing.page_seen);
  EXPECT_FALSE(state().map.live.running());
  show("Wall");
  EXPECT_FALSE(state().timing.page_seen);
  show("Plots*,Wall");
  const std::uint64_t drawn = application_->renderer().times_drawn();
  live(500);
  EXPECT_EQ(application_->renderer().times_drawn(), drawn) << "the wall is behind the plots";
  click("page Wall");
  live(500);
  EXPECT_GT(application_->renderer().times_drawn(), drawn);
}

TEST_F(DockTest, ABlindTestHidesWhateverTheLayoutAndItComesBack) {
  std::vector<std::string> texts{"Contact+Map,Plots,Blind test@10%,10%,60%,60%", ""};
  for (const ui::BuiltinLayout& layout : ui::builtin_layouts()) texts.emplace_back(layout.text);
  for (const std::string& text : texts) {
    SCOPED_TRACE(text);
    show(text);
    show_page(state().dock, ui::kBlindTestPage);
    frames(4);
    const std::string before = chosen();
    start_trials(4);
    frames(4);
    ASSERT_TRUE(ui::blind_test_runs(state().compare));
    EXPECT_THAT(seen(), ::testing::Contains("Blind test"));
    for (const ui::Page& page : ui::pages()) {
      if (page.hidden_by_blind_test)
        EXPECT_THAT(seen(), ::testing::Not(::testing::Contains(page.window.name)));
    }
    EXPECT_FALSE(sees("layout")) << "the choice would show a hidden window";
    click("stop and show");
    frames(4);
    EXPECT_EQ(chosen(), before);
    EXPECT_THAT(seen(), UnorderedElementsAreArray(fronts_of(*parse_layout(before))));
  }
}

TEST_F(DockTest, ThePresentArrangementIsKeptFromOneStartToTheNext) {
  options.settings_path = path("settings.json");
  open("press");
  drag_by("gap 1", ImVec2(0.0F, 70.0F));
  click("page Map");
  const std::string before = chosen();
  application_->save_settings();
  open("press");
  EXPECT_EQ(chosen(), before);
  EXPECT_THAT(seen(), ::testing::Contains("Map"));
  put("settings.json", R"({"window": {"more": true, "layout": "mine", "docked": "Y40%(Wall"}})");
  open("press");
  EXPECT_EQ(state().dock.layout, "bench");
  EXPECT_THAT(seen(), UnorderedElementsAreArray({"Controls", "Wall", "Contact", "Plots"}));
  EXPECT_THAT(message().text, HasSubstr("there is no layout 'mine'"));
}

// Random clicks, drags, sizes and layouts: nothing leaves the window, and the text is read back.
TEST_F(DockTest, AnyUseLeavesAnArrangementThatCanBeKept) {
  std::mt19937 random(3);
  const auto below = [&](std::size_t end) { return random() % end; };
  const auto anywhere = [&] {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    return ImVec2(static_cast<float>(below(1000)) / 1000.0F * screen.x,
                  100.0F + static_cast<float>(below(1000)) / 1000.0F * (screen.y - 150.0F));
  };
  for (int round = 0; round < 120; ++round) {
    const std::size_t which = below(8);
    const std::vector<std::string> open = windows_of(*dock().chosen);
    if (which == 0) choose(ui::builtin_layouts()[below(ui::builtin_layouts().size())].name);
    if (which == 1) resize(1000.0F + static_cast<float>(below(600)), 640.0F, below(2) ? 100 : 150);
    if (which == 2) show_page(state().dock, ui::pages()[below(ui::pages().size())].window.name);
    if (which > 2 && !open.empty()) {
      const auto tab = find("page " + open[below(open.size())]);
      if (tab && tab->id != 0) drag(tab->centre(), anywhere());
    }
    frames(4);
    const auto again = parse_layout(chosen());
    ASSERT_TRUE(again.has_value()) << chosen();
    EXPECT_EQ(windows_of(*again), windows_of(*dock().chosen));
    EXPECT_THAT(seen(), UnorderedElementsAreArray(fronts_of(dock().measured))) << chosen();
    const ImRect screen(ImVec2(0.0F, 0.0F), ImGui::GetIO().DisplaySize);
    for (const std::string& page : seen()) EXPECT_TRUE(screen.Contains(area(page))) << page;
  }
}

}  // namespace
}  // namespace hapticwall::test
