#include "app/ui/state/undo.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/algorithm/algorithm.h"
#include "core/scene_keys.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using ::testing::HasSubstr;
using ui::same_scene;
using ui::UndoHistory;

Scene press_scene() { return file::load_scene("press")->scene; }

Scene with_stiffness(double stiffness_n_per_m) {
  Scene scene = press_scene();
  scene.x().walls[0].stiffness_n_per_m = stiffness_n_per_m;
  return scene;
}

// Any change that the window can make.
Scene edited(Scene scene, std::mt19937& random) {
  const auto pick = [&](std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
  };
  const double factor = std::uniform_real_distribution<double>(0.5, 2.0)(random);
  switch (pick(7)) {
    case 0:
      scene.x().walls[0].stiffness_n_per_m =
          std::min(1e5, scene.x().walls[0].stiffness_n_per_m * factor);
      break;
    case 1:
      scene.x().walls[0].damping_n_s_per_m += 0.1;
      break;
    case 2:
      scene.x().device.friction_n =
          scene.x().device.friction_n ? std::nullopt : std::optional(0.1 * factor);
      break;
    case 3:
      scene.algorithm.index = pick(algorithms().size());
      break;
    case 4:
      scene.simulator = {Integrator::kRungeKutta4, static_cast<int>(pick(20)) + 1};
      break;
    case 5:
      scene.x().hand->stiffness_n_per_m = std::min(1e4, scene.x().hand->stiffness_n_per_m * factor);
      break;
    default:
      scene.sampling.rate_hz = 500.0 * static_cast<double>(pick(6) + 1);  // takes a new session
      break;
  }
  return scene;
}

TEST(UndoHistory, GoesBackAndForthAndForgetsWhatWasUndone) {
  UndoHistory history;
  const Scene loaded = press_scene();
  for (const double stiffness : {1000.0, 2000.0, 3000.0})
    history.observe(with_stiffness(stiffness), loaded, false);
  EXPECT_FALSE(history.can_redo());
  EXPECT_EQ(history.undo()->scene.x().walls[0].stiffness_n_per_m, 2000.0);
  history.observe(with_stiffness(2000.0), loaded, false);
  EXPECT_EQ(history.redo()->scene.x().walls[0].stiffness_n_per_m, 3000.0);
  history.observe(with_stiffness(2000.0), loaded, false);  // the session has refused
  EXPECT_EQ(history.undo()->scene.x().walls[0].stiffness_n_per_m, 1000.0);
  history.observe(with_stiffness(1000.0), loaded, false);
  EXPECT_FALSE(history.can_undo());
  history.observe(with_stiffness(7000.0), loaded, false);
  EXPECT_FALSE(history.can_redo());
  EXPECT_EQ(history.size(), 2U);
  EXPECT_EQ(history.undo()->scene.x().walls[0].stiffness_n_per_m, 1000.0);
}

TEST(UndoHistory, ADragIsOneStepAndTheNextDragAnother) {
  UndoHistory history;
  const Scene loaded = press_scene();
  history.observe(with_stiffness(1000.0), loaded, false);
  for (int i = 1; i <= 10; ++i) history.observe(with_stiffness(1000.0 + i), loaded, true);
  history.observe(with_stiffness(1010.0), loaded, false);
  for (int i = 1; i <= 10; ++i) history.observe(with_stiffness(2000.0 + i), loaded, true);
  history.observe(with_stiffness(2010.0), loaded, false);
  EXPECT_EQ(history.size(), 3U);
  EXPECT_EQ(history.undo()->scene.x().walls[0].stiffness_n_per_m, 1010.0);
}

TEST(UndoHistory, AStepThatTheDeviceChangesIsStillThatStep) {
  UndoHistory history;
  const Scene loaded = press_scene();
  history.observe(with_stiffness(1000.0), loaded, false);
  history.observe(with_stiffness(2000.0), loaded, false);
  ASSERT_TRUE(history.undo());
  Scene near = with_stiffness(1000.0);
  near.x().device.force_limit_n = 1.0;
  history.observe(near, loaded, false);
  EXPECT_FALSE(history.can_undo());
  EXPECT_TRUE(history.can_redo());
}

TEST(UndoHistory, KeepsTheNewestSteps) {
  UndoHistory history;
  const Scene loaded = press_scene();
  for (std::size_t i = 0; i < ui::kMaxUndoSteps + 50; ++i)
    history.observe(with_stiffness(1.0 + static_cast<double>(i)), loaded, false);
  EXPECT_EQ(history.size(), ui::kMaxUndoSteps);
  EXPECT_EQ(history.undo()->scene.x().walls[0].stiffness_n_per_m,
            static_cast<double>(ui::kMaxUndoSteps + 49));
}

TEST(UndoHistory, NamesTheChangeThatUndoTakesBack) {
  UndoHistory history;
  const Scene loaded = press_scene();
  EXPECT_EQ(history.undo_text(), "");
  history.observe(loaded, loaded, false);
  history.observe(with_stiffness(2000.0), loaded, false);
  EXPECT_THAT(history.undo_text(), HasSubstr("wall stiffness: 35 kN/m"));
  Scene other = with_stiffness(2000.0);
  other.sampling.rate_hz = 2000.0;
  history.observe(other, loaded, false);
  EXPECT_EQ(history.undo_text(), "sampling rate 1000 Hz");
}

TEST(SameScene, SeesEveryPart) {
  std::mt19937 random(3);
  const Scene scene = press_scene();
  EXPECT_TRUE(same_scene(scene, press_scene()));
  for (int round = 0; round < 100; ++round) {
    const Scene other = edited(scene, random);
    const bool changed =
        other.x().walls != scene.x().walls || other.x().device != scene.x().device ||
        other.x().hand != scene.x().hand || !(other.algorithm == scene.algorithm) ||
        !(other.simulator == scene.simulator) || other.sampling.rate_hz != scene.sampling.rate_hz;
    EXPECT_EQ(same_scene(scene, other), !changed);
  }
}

class UndoTest : public GuiTest {
 protected:
  [[nodiscard]] double stiffness() const { return wall().stiffness_n_per_m; }
};

TEST_F(UndoTest, UndoInATextFieldKeepsTheScene) {
  type("stiffness", "20000");
  click("damping");
  write("7");
  press(ImGuiMod_Ctrl | ImGuiKey_Z);
  EXPECT_EQ(stiffness(), 20000.0);
}

TEST_F(UndoTest, ADragOfASliderIsOneStep) {
  const ItemRect slider = rect("stiffness-slider");
  move_to(slider.at(0.3F, 0.5F));
  mouse_button(true);
  for (const float share : {0.4F, 0.5F, 0.6F, 0.7F, 0.8F}) {
    move_to(slider.at(share, 0.5F));
    EXPECT_NEAR(std::log10(stiffness()), 2.0 + 4.0 * static_cast<double>(share), 0.15);
  }
  mouse_button(false);
  EXPECT_EQ(state().scene.undo.size(), 2U);
  press(ImGuiMod_Ctrl | ImGuiKey_Z);
  EXPECT_EQ(stiffness(), 35000.0);
}

TEST_F(UndoTest, ARateTakesItsSessionBackAndAnotherSceneToo) {
  type("rate", "2000");
  EXPECT_EQ(sessions, 2);
  press(ImGuiMod_Ctrl | ImGuiKey_Z);
  EXPECT_EQ(sessions, 3);
  EXPECT_EQ(scene().sampling.rate_hz, 1000.0);
  type("stiffness", "20000");
  click_figure("Figure 5");
  EXPECT_FALSE(sees("reset to scene"));
  EXPECT_EQ(stiffness(), 35000.0);
  press(ImGuiMod_Ctrl | ImGuiKey_Z);
  EXPECT_EQ(stiffness(), 20000.0);
  EXPECT_TRUE(sees("reset to scene"));
  click("reset to scene");
  EXPECT_EQ(stiffness(), 35000.0);
  press(ImGuiMod_Ctrl | ImGuiKey_Z);
  EXPECT_EQ(stiffness(), 20000.0) << "a reset to the scene is a step, too";
}

TEST_F(UndoTest, ASessionThatDoesNotStartLeavesTheStepThere) {
  type("rate", "2000");
  refuse_session = "no loop to be had";
  press(ImGuiMod_Ctrl | ImGuiKey_Z);
  EXPECT_EQ(message().text, "no loop to be had");
  EXPECT_EQ(application_->session().scene().sampling.rate_hz, 2000.0);
  refuse_session.clear();
  press(ImGuiMod_Ctrl | ImGuiKey_Z);
  EXPECT_EQ(application_->session().scene().sampling.rate_hz, 1000.0);
}

// Property: undo goes back through every state to the first one, and redo to the last one.
TEST_F(UndoTest, AnyEditsAreUndoneAndRedoneStateByState) {
  std::mt19937 random(20240);
  for (int round = 0; round < 5; ++round) {
    open("press");
    std::vector<Scene> states{scene()};
    while (states.size() < 15) {
      const Scene wanted = edited(scene(), random);
      if (same_scene(wanted, scene())) continue;
      if (session::needs_new_session(scene(), wanted)) {
        state().scene.wanted = ui::WantedScene{wanted};
      } else {
        ASSERT_FALSE(fake_->change_scene(wanted));
      }
      frames(1);
      states.push_back(scene());
    }
    for (std::size_t i = states.size() - 1; i-- > 0;) {
      press(ImGuiMod_Ctrl | ImGuiKey_Z);
      ASSERT_TRUE(same_scene(scene(), states[i])) << "back to " << i;
    }
    for (std::size_t i = 1; i < states.size(); ++i) {
      press(ImGuiMod_Ctrl | ImGuiKey_Y);
      ASSERT_TRUE(same_scene(scene(), states[i])) << "on to " << i;
    }
  }
}

}  // namespace
}  // namespace hapticwall::test
