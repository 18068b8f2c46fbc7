// What people do with the window: scenes, values, undo, settings, the views, the scope.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "app/file/disk/small_file.h"
#include "app/file/scene/settings_text.h"
#include "app/ui/page/magnifier.h"
#include "core/stabiliser/stabiliser.h"
#include "tests/window/rows.h"
#include "tests/window/window_test.h"

namespace hapticwall::test {
namespace {

class UseWindowTest : public WindowTest {
 protected:
  file::Settings kept_settings() const {
    const auto text =
        file::read_small_file(home_.settings_path(), "settings", file::kMaxSettingsBytes);
    EXPECT_TRUE(text.ok()) << text.error().message;
    const auto settings = file::parse_settings(*text, "settings");
    EXPECT_TRUE(settings.ok());
    return settings ? *settings : file::Settings{};
  }
};

TEST_P(UseWindowTest, OpensASceneThatIsDroppedOntoIt) {
  const std::string good = home_.write_scene("dropped", "tap", {"wall.stiffness_n_per_m=777"});
  const std::string missing = (home_.folder() / "missing.toml").string();
  use([&](Person& person) {
    person.drop(std::array{missing});
    person.wait_a_frame();
    EXPECT_EQ(person.message().kind, ui::MessageKind::kProblem);
    EXPECT_EQ(person.scene().name, "press");
    person.drop(std::array{good});
    person.wait_until([&] { return person.scene().name == "dropped"; }, "the scene");
    EXPECT_EQ(person.scene().x().walls.front().stiffness_n_per_m, 777.0);
    person.wait_for_ticks(10);
    ASSERT_FALSE(person.state().persisted.recent.empty());
    EXPECT_EQ(person.state().persisted.recent.front(), good);
  });
}

TEST_P(UseWindowTest, ARefusedValueIsSaidAndChangesNothing) {
  use([](Person& person) {
    const Scene before = person.scene();
    for (const char* bad : {"-5", "1e99", "abc", "nan"}) {
      SCOPED_TRACE(bad);
      person.put_everything_away();
      person.type("stiffness", bad);
      EXPECT_EQ(person.message().kind, ui::MessageKind::kProblem);
      EXPECT_TRUE(ui::same_scene(person.scene(), before));
    }
    unfold(person, "Device", "device.mass_kg");
    person.wait_a_frame();
    for (const char* bad : {"0", "-1", "1e9", "heavy"}) {
      SCOPED_TRACE(bad);
      person.type("device.mass_kg", bad);
      ASSERT_TRUE(person.state().transient.refusal);
      EXPECT_EQ(person.state().transient.refusal->key, "device.mass_kg");
      EXPECT_TRUE(ui::same_scene(person.scene(), before));
    }
    person.type("device.mass_kg", "0.06");
    EXPECT_FALSE(person.state().transient.refusal);
    EXPECT_EQ(person.scene().x().device.mass_kg, 0.06);
    EXPECT_TRUE(person.state().transient.undo.redo_text().empty());
  });
}

TEST_P(UseWindowTest, EscapeLeavesWhatWasInAField) {
  use([](Person& person) {
    const Scene before = person.scene();
    person.click("stiffness");
    person.write("5");
    person.press(ImGuiKey_Escape);
    EXPECT_TRUE(ui::same_scene(person.scene(), before));
    EXPECT_FALSE(person.state().transient.undo.can_undo());
  });
}

TEST_P(UseWindowTest, EveryStepIsTakenBackAndDoneAgain) {
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
    EXPECT_EQ(person.state().transient.undo.size(), 5U) << "a drag is one step";
    for (int i = 0; i < 4; ++i) person.click("undo");
    EXPECT_TRUE(ui::same_scene(person.scene(), at_first));
    EXPECT_FALSE(person.state().transient.undo.can_undo());
    for (int i = 0; i < 4; ++i) person.press(ImGuiMod_Ctrl | ImGuiKey_Y);
    EXPECT_TRUE(ui::same_scene(person.scene(), at_last));
  });
}

TEST_P(UseWindowTest, KeepsSettingsFromOneStartToTheNext) {
  use([](Person& person) {
    person.click("settings");
    person.click("light");
    person.type("scale percent", "110");
    person.put_everything_away();
    person.click("phase plane");
    person.click("magnify more");
    person.click("legend handle");
    person.click("time window");
    person.wait_a_frame();
    person.click("length 1 s");
  });
  const file::Settings kept = kept_settings();
  EXPECT_EQ(kept.at("window.theme"), file::SettingValue(std::string("light")));
  EXPECT_EQ(kept.at("window.scale_percent"), file::SettingValue(110.0));
  EXPECT_EQ(kept.at("plots.time_window_s"), file::SettingValue(1.0));
  use([](Person& person) {
    const ui::UiState& state = person.state();
    EXPECT_EQ(state.persisted.look, draw::Look::kLight);
    EXPECT_EQ(state.persisted.scale_percent, 110);
    EXPECT_EQ(state.persisted.time_window_s, 1.0);
    EXPECT_NE(state.persisted.hidden_lines, 0U);
    EXPECT_TRUE(state.plots.persisted.phase.shown);
    EXPECT_GT(state.wall.persisted.magnification, 0);
    EXPECT_FLOAT_EQ(ImGui::GetStyle().FontScaleMain, 1.1F);
  });
}

TEST_P(UseWindowTest, TheButtonsOfTheMagnifierStayWhereTheyAre) {
  use([](Person& person) {
    ui::WallState& wall = person.state().wall;
    const auto place = [&] { return find_item("magnify more")->from.x; };
    wall.persisted.magnification = ui::kMagnifications.front();
    person.wait_a_frame();
    const float before = place();
    wall.persisted.magnification = ui::kMagnifications.back();
    person.wait_a_frame();
    EXPECT_EQ(place(), before);
  });
}

TEST_P(UseWindowTest, WritesSettingsWhileItRuns) {
  use([this](Person& person) {
    person.press(ImGuiKey_F2);
    person.wait_until(
        [&] {
          const file::Settings kept = kept_settings();
          const auto theme = kept.find("window.theme");
          return theme != kept.end() && theme->second == file::SettingValue(std::string("light"));
        },
        "the settings file");
  });
}

TEST_P(UseWindowTest, ThePointerLeadsTheHandWhileItIsDown) {
  use([](Person& person) {
    person.drag("wall view", ImVec2(60.0F, 0.0F));
    EXPECT_FALSE(person.state().transient.hand_m) << "let go: the script leads again";
    unfold(person, "Hand", "hand stays");
    person.wait_a_frame();
    person.click("hand stays");
    person.drag("wall view", ImVec2(60.0F, 0.0F));
    ASSERT_TRUE(person.state().transient.hand_m);
    const double led_m = *person.state().transient.hand_m;
    person.wait_until(
        [&] {
          return std::abs(person.session().snapshot().newest.x().truth.hand_path_m - led_m) < 1e-9;
        },
        "the hand where it was let go");
    person.click("hand stays");
    EXPECT_FALSE(person.state().transient.hand_m);
  });
}

TEST_P(UseWindowTest, AManualAxisStaysWhileTheSessionRuns) {
  use([](Person& person) {
    const auto& axes = person.state().plots.transient.axes;
    const auto& force = axes[static_cast<std::size_t>(draw::PlotId::kForce)].left;
    person.drag_from("plot Force", ImVec2(-0.04F, 0.5F), ImVec2(0.0F, 25.0F));
    ASSERT_TRUE(force.manual);
    const draw::ValueAxis before = force;
    person.wait_for_ticks(300);
    person.wait_a_frame();
    EXPECT_EQ(force.minimum, before.minimum);
    EXPECT_EQ(force.maximum, before.maximum);
    EXPECT_TRUE(person.state().transient.follow) << "values are not time";
    person.double_click("plot Force");
    EXPECT_FALSE(force.manual);
  });
}

TEST_P(UseWindowTest, FrozenPlotsStandStill) {
  use([](Person& person) {
    const ui::TransientState& transient = person.state().transient;
    person.wait_for_ticks(100);
    person.press(ImGuiKey_F);
    const double to_s = transient.time_to_s;
    person.wait_for_ticks(200);
    person.wait_a_frame();
    EXPECT_EQ(transient.time_to_s, to_s);
    person.click("time window");
    person.wait_a_frame();
    person.click("length 100 ms");
    EXPECT_TRUE(transient.follow);
    const double newest_s = person.history().newest_time_s();
    person.wait_until([&] { return transient.time_to_s > newest_s; }, "the plots going on");
  });
}

TEST_P(UseWindowTest, ASingleTriggerCatchesTheContactAndKeepsIt) {
  use([](Person& person) {
    const auto& trigger = person.state().plots.transient.trigger;
    person.click("time window");
    person.wait_a_frame();
    person.click("length 200 ms");
    person.click("trigger");
    person.wait_a_frame();
    person.click("trigger single");
    person.put_everything_away();
    person.click("reset");
    person.wait_until([&] { return trigger.stage == draw::TriggerStage::kDone; }, "a contact");
    person.wait_a_frame();
    EXPECT_FALSE(person.state().transient.follow);
    ASSERT_TRUE(trigger.contact_s);
    const double contact_s = *trigger.contact_s;
    EXPECT_LT(person.state().transient.time_from_s, contact_s);
    EXPECT_GT(person.state().transient.time_to_s, contact_s);
    person.wait_for_ticks(100);
    EXPECT_EQ(trigger.contact_s, contact_s);
    person.click("follow");  // arms it again
    EXPECT_TRUE(person.state().transient.follow);
  });
}

TEST_P(UseWindowTest, ACursorIsDragged) {
  use([](Person& person) {
    const auto& cursors = person.state().plots.transient.cursors;
    person.wait_for_ticks(200);
    person.press(ImGuiKey_F);
    person.press(ImGuiKey_C);
    ASSERT_TRUE(cursors.shown);
    person.wait_a_frame();
    const auto before = cursors.time_s;
    const ui::TransientState& transient = person.state().transient;
    const double share =
        (before[0] - transient.time_from_s) / (transient.time_to_s - transient.time_from_s);
    person.drag_from("plot Position", ImVec2(static_cast<float>(share), 0.5F), ImVec2(20.0F, 0.0F));
    EXPECT_GT(cursors.time_s[0], before[0]);
    EXPECT_EQ(cursors.time_s[1], before[1]);
  });
}

TEST_P(UseWindowTest, TheHelpIsPutAwayByAClickElsewhere) {
  use([](Person& person) {
    person.press(ImGuiKey_F1);
    ASSERT_TRUE(person.state().transient.help_shown);
    person.wait_a_frame();
    person.drag_from("scene", ImVec2(0.1F, -0.6F), ImVec2(0.0F, 0.0F));
    EXPECT_FALSE(person.state().transient.help_shown);
  });
}

HAPTICWALL_ON_BOTH_SCREENS(UseWindowTest);

}  // namespace
}  // namespace hapticwall::test
