// What the machine lacks has no control, no key and no page.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "app/ui/panel/layout_choice.h"
#include "app/ui/state/dock_state.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ui::Capabilities;

constexpr Capabilities kNothing{false, false, false, false, false, false};

class CapabilitiesTest : public GuiTest {
 protected:
  void open_with(const Capabilities& can) {
    options.can = can;
    application_.reset();
    open("press");
  }
  // Controls of the window with everything shown; those of lists and pages come by clicks.
  std::set<std::string> controls(const Capabilities& can,
                                 const std::vector<std::string>& clicks = {}) {
    open_with(can);
    for (const std::string& each : clicks) click(each);
    std::set<std::string> names;
    for (const auto& [name, item] : drawn_items()) {
      if (item.id != 0) names.insert(name);
    }
    if (!clicks.empty()) press(ImGuiKey_Escape);  // the next window begins without its list
    return names;
  }
  // What a window has only with everything.
  std::vector<std::string> lacking(const Capabilities& can,
                                   const std::vector<std::string>& clicks = {}) {
    const std::set<std::string> desktop = controls({}, clicks);
    const std::set<std::string> here = controls(can, clicks);
    std::vector<std::string> names;
    std::ranges::set_difference(desktop, here, std::back_inserter(names));
    return names;
  }
  std::vector<std::string> windows() {
    std::vector<std::string> names;
    for (const ui::DockWindow& window : state().dock.windows) names.emplace_back(window.name);
    return names;
  }
};

Capabilities all_but(ui::Needs lacking) {
  Capabilities can;
  can.*lacking = false;
  return can;
}

TEST_F(CapabilitiesTest, WithoutFilesNothingIsRecordedExportedOrOpened) {
  const Capabilities can = all_but(&Capabilities::files);
  EXPECT_THAT(lacking(can),
              testing::IsSupersetOf({"record", "recording name", "export csv", "export png"}));
  EXPECT_THAT(windows(), Not(Contains(ui::kBlindTestPage)));
  EXPECT_THAT(lacking(can, {"settings"}),
              testing::IsSupersetOf({"recording folder", "record signals"}));
  EXPECT_THAT(controls(can, {"settings"}), Contains("reset layout"));
  EXPECT_THAT(lacking(can, {"scene"}), Contains("open path"));
  EXPECT_THAT(controls(can, {"scene"}), Contains("scene tap"));
  open_with(can);
  press(ImGuiMod_Ctrl | ImGuiKey_R);
  EXPECT_EQ(fake_->recording_status().state, session::RecordingState::kIdle);
  put("a.toml", file::scene_to_toml(file::load_scene("tap")->scene));
  drop("a.toml");
  EXPECT_EQ(scene().name, "press");
}

TEST_F(CapabilitiesTest, EachOfTheOthersHidesItsOwn) {
  open_with(all_but(&Capabilities::devices));
  EXPECT_THAT(windows(), Not(Contains("Identify")));
  EXPECT_THAT(windows(), Contains("Map"));
  open_with(all_but(&Capabilities::threads));
  EXPECT_THAT(windows(), Not(Contains("Map")));
  EXPECT_THAT(windows(), Not(Contains("Study")));
  EXPECT_THAT(windows(), Contains("All at once"));
  open_with(all_but(&Capabilities::timing));
  EXPECT_THAT(windows(), Not(Contains("Timing")));
  EXPECT_THAT(text(), Not(HasSubstr("wake-up")));
  EXPECT_THAT(text(), HasSubstr("missed"));
  EXPECT_THAT(lacking(all_but(&Capabilities::sound)), ElementsAre("sound"));
  open_with(all_but(&Capabilities::all_keys));
  press(ImGuiKey_F5);
  EXPECT_FALSE(state().window.presents);
  open_with({});
  press(ImGuiKey_F5);
  EXPECT_TRUE(state().window.presents);
}

TEST_F(CapabilitiesTest, TheHelpSpeaksOfNothingThatIsNotThere) {
  open_with({});
  press(ImGuiKey_F1);
  EXPECT_THAT(text(), HasSubstr("Ctrl+R"));
  EXPECT_THAT(text(), HasSubstr("real device"));
  open_with(kNothing);
  press(ImGuiKey_F1);
  const std::string help = text();
  for (const char* absent : {"Ctrl+R", "real device", "F5", "recording", "drag a file"})
    EXPECT_THAT(help, Not(HasSubstr(absent)));
  EXPECT_THAT(help, HasSubstr("Ctrl+Z"));
}

// Layouts name pages; those that are not there leave no gap and no tab.
TEST_F(CapabilitiesTest, EveryLayoutDoesWithoutThem) {
  open_with(kNothing);
  const std::vector<std::string> there = windows();
  EXPECT_THAT(there,
              ElementsAre(ui::kControlsPage, "Wall", "Contact", ui::kPlotsPage, "All at once"));
  std::set<std::string> seen;
  for (std::size_t i = 0; i < ui::builtin_layouts().size(); ++i) {
    press(ImGuiKey_F3);
    frames(5);
    seen.insert(state().dock.layout);
    for (const std::string& name : windows_of(state().dock.shown))
      EXPECT_THAT(there, Contains(name));
  }
  EXPECT_THAT(seen, Not(Contains("experiment")));
  EXPECT_EQ(seen.size(), ui::builtin_layouts().size() - 1);
}

}  // namespace
}  // namespace hapticwall::test
