// Work over many controls: undo, settings that stay, a hand that the pointer leads.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/paths.h"
#include "tests/window/rows.h"
#include "tests/window/window_test.h"

namespace hapticwall::test {
namespace {

class UseWindowTest : public WindowTest {
 protected:
  nlohmann::json kept_settings() const {
    return nlohmann::json::parse(text_of(home_.settings_path()));
  }
};

TEST_F(UseWindowTest, EscapeLeavesWhatWasInAField) {
  use([](Person& person) {
    const Scene before = person.scene();
    person.click("stiffness");
    person.write("5");
    person.press(ImGuiKey_Escape);
    EXPECT_TRUE(ui::same_scene(person.scene(), before));
    EXPECT_FALSE(person.state().scene.undo.can_undo());
  });
}

TEST_F(UseWindowTest, EveryStepIsTakenBackAndDoneAgain) {
  use([](Person& person) {
    const Scene at_first = person.scene();
    person.type("stiffness", "3000");
    person.drag("damping-slider", ImVec2(50.0F, 0.0F));
    person.click("virtual-coupling");
    person.ctrl_click("stiffness-slider");
    person.write("4000");
    person.press(ImGuiKey_Enter);
    const Scene at_last = person.scene();
    EXPECT_EQ(at_last.x().walls.front().stiffness_n_per_m, 4000.0);
    EXPECT_EQ(person.state().scene.undo.size(), 5U) << "a drag is one step";
    for (int i = 0; i < 4; ++i) person.click("undo");
    EXPECT_TRUE(ui::same_scene(person.scene(), at_first));
    EXPECT_FALSE(person.state().scene.undo.can_undo());
    for (int i = 0; i < 4; ++i) person.press(ImGuiMod_Ctrl | ImGuiKey_Y);
    EXPECT_TRUE(ui::same_scene(person.scene(), at_last));
  });
}

TEST_F(UseWindowTest, KeepsSettingsFromOneStartToTheNext) {
  use([this](Person& person) {
    person.click("settings");
    person.click("light");
    person.wait_until([&] { return kept_settings()["window"].contains("theme"); },
                      "the settings file while the window is open");
    person.type("scale percent", "110");
    person.put_everything_away();
    person.click("phase plane");
    person.click("magnify more");
    person.click("legend handle");
    person.click("time window");
    person.click("length 1 s");
  });
  const nlohmann::json kept = kept_settings();
  EXPECT_EQ(kept["window"]["theme"], "light");
  EXPECT_EQ(kept["window"]["scale_percent"], 110);
  EXPECT_EQ(kept["plots"]["time_window_s"], 1.0);
  use([](Person& person) {
    const ui::UiState& state = person.state();
    EXPECT_EQ(state.appearance.look, draw::Look::kLight);
    EXPECT_EQ(state.appearance.scale_percent, 110);
    EXPECT_EQ(state.time.window_s, 1.0);
    EXPECT_NE(state.plots.persisted.hidden_lines, 0U);
    EXPECT_TRUE(state.plots.persisted.phase.shown);
    EXPECT_GT(state.wall.persisted.magnification, 0);
    EXPECT_FLOAT_EQ(ImGui::GetStyle().FontScaleMain, 1.1F);
  });
}

TEST_F(UseWindowTest, TheHandIsLedWithdrawnAndGivenBackByAReset) {
  use([](Person& person) {
    const auto hand_m = [&] { return person.session().snapshot().newest.x().truth.hand_path_m; };
    person.drag("wall view", ImVec2(60.0F, 0.0F));
    EXPECT_TRUE(person.state().hand.led);
    person.press(ImGuiKey_H);
    person.wait_until([&] { return hand_m() == person.scene().x().device.start_m; },
                      "the hand where the scene begins");
    person.press(ImGuiKey_R);
    EXPECT_FALSE(person.state().hand.led);
    person.wait_until([&] { return hand_m() > person.scene().x().device.start_m; }, "the script");
  });
}

}  // namespace
}  // namespace hapticwall::test
