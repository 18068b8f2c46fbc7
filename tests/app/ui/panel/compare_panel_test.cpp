// Comparison by touch: slots, Tab, undo, and ghosts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/ui/state/comparing.h"
#include "core/algorithm/algorithm.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using compare::Slot;
using ::testing::HasSubstr;

class ComparePanelTest : public GuiTest {
 protected:
  [[nodiscard]] std::string running() const { return ui::algorithm_name(scene().algorithm); }
  [[nodiscard]] ui::CompareSlots slots() const { return ui::slots_of(state().compare); }
  [[nodiscard]] std::string in(Slot slot) const { return ui::algorithm_name(slots().of(slot)); }
  // Moves the hand out of the wall and in again.
  void touch_again() {
    fake_->move_hand(session::test::hand_to(0.03));
    live(2000);
    fake_->move_hand(session::test::hand_to(0.07));
    live(1500);
  }
  // Ticks of the contact that begins last, after a rest.
  [[nodiscard]] std::vector<Sample> last_contact() const {
    const draw::SampleHistory& history = application_->history();
    std::size_t begin = 0;
    std::size_t resting = 0;
    for (std::size_t i = 0; i < history.size(); ++i) {
      const Sample sample = history.sample(i);
      const bool contact = (sample.flags & kFlagInContact) != 0;
      if (contact && resting >= 250) begin = i;
      resting = contact || sample.force_n != 0.0 ? 0 : resting + 1;
    }
    std::vector<Sample> samples;
    for (std::size_t i = begin; i < history.size(); ++i) samples.push_back(history.sample(i));
    return samples;
  }
  [[nodiscard]] const std::vector<draw::ExtraTrace>& traces() const {
    return state().plots.transient.extra_traces;
  }
};

TEST_F(ComparePanelTest, BeginsWithTheScenesAlgorithmAndAnother) {
  EXPECT_EQ(running(), "energy-bounding");
  EXPECT_EQ(in(Slot::kA), "energy-bounding");
  EXPECT_EQ(in(Slot::kB), "none");
  click_figure("Figure 5");
  EXPECT_EQ(in(Slot::kA), "virtual-coupling");
  EXPECT_EQ(in(Slot::kB), "none") << "the other slot stays";
  click_figure("Figure 4");
  EXPECT_EQ(in(Slot::kA), "none");
  EXPECT_EQ(in(Slot::kB), "energy-bounding") << "the two differ";
}

TEST_F(ComparePanelTest, TabAndClicksToggleWithoutAStepOfTheUndo) {
  const std::string first = running();
  press(ImGuiKey_Tab);
  EXPECT_EQ(running(), "none");
  EXPECT_EQ(slots().active, Slot::kB);
  EXPECT_FALSE(ImGui::GetIO().WantTextInput) << "Tab moves the keyboard to no field";
  press(ImGuiKey_Tab);
  EXPECT_EQ(running(), first);
  click("slot B");
  EXPECT_EQ(running(), "none");
  click("slot A");
  EXPECT_EQ(running(), first);
  EXPECT_EQ(state().scene.undo.size(), 1U);
}

TEST_F(ComparePanelTest, InAFieldTabMovesOn) {
  const std::string before = running();
  click("stiffness");
  ASSERT_TRUE(ImGui::GetIO().WantTextInput);
  press(ImGuiKey_Tab);
  EXPECT_EQ(running(), before);
  EXPECT_TRUE(ImGui::GetIO().WantTextInput) << "the next field";
  press(ImGuiKey_Escape);
  press(ImGuiKey_Tab);
  EXPECT_EQ(running(), "none");
}

TEST_F(ComparePanelTest, AnEditIsOfTheActiveSlot) {
  const std::string a = in(Slot::kA);
  press(ImGuiKey_Tab);
  click("passivity-control");
  EXPECT_EQ(in(Slot::kB), "passivity-control");
  EXPECT_EQ(in(Slot::kA), a);
  press(ImGuiKey_Tab);
  EXPECT_EQ(running(), a);
  press(ImGuiKey_Tab);
  EXPECT_EQ(running(), "passivity-control");
  click("take A");
  EXPECT_EQ(in(Slot::kA), "passivity-control");
  EXPECT_EQ(slots().of(Slot::kA), slots().of(Slot::kB));
}

TEST_F(ComparePanelTest, UndoKeepsTheSlotsApart) {
  const std::string a = in(Slot::kA);
  click("passivity-control");  // in A
  press(ImGuiKey_Tab);
  type("stiffness", "20000");  // in B
  press(ImGuiMod_Ctrl | ImGuiKey_Z);
  EXPECT_EQ(wall().stiffness_n_per_m, 35000.0);
  EXPECT_EQ(running(), "none") << "the active slot stays active";
  EXPECT_THAT(state().scene.undo.undo_text(), HasSubstr("slot A: " + a));
  press(ImGuiMod_Ctrl | ImGuiKey_Z);
  EXPECT_EQ(in(Slot::kA), a);
  EXPECT_EQ(in(Slot::kB), "none");
  EXPECT_EQ(running(), "none");
  press(ImGuiMod_Ctrl | ImGuiKey_Y);
  EXPECT_EQ(in(Slot::kA), "passivity-control");
  press(ImGuiKey_Tab);
  EXPECT_EQ(running(), "passivity-control");
  press(ImGuiMod_Ctrl | ImGuiKey_Y);
  EXPECT_EQ(wall().stiffness_n_per_m, 20000.0);
  EXPECT_EQ(running(), "passivity-control");
}

TEST_F(ComparePanelTest, TakingIsAStepAndAnotherRateKeepsTheSlots) {
  press(ImGuiKey_Tab);
  const std::string a = in(Slot::kA);
  click("take A");
  EXPECT_EQ(in(Slot::kA), "none");
  press(ImGuiMod_Ctrl | ImGuiKey_Z);
  EXPECT_EQ(in(Slot::kA), a);
  scroll_down_at("slot A");
  type("rate", "2000");
  EXPECT_EQ(in(Slot::kA), a);
  EXPECT_EQ(slots().active, Slot::kB);
  EXPECT_EQ(running(), "none");
}

TEST_F(ComparePanelTest, AGhostStandsAtThePresentContact) {
  live(3000);
  const std::vector<Sample> first = last_contact();
  const std::string label = "ghost of A: " + running();
  EXPECT_TRUE(traces().empty());
  press(ImGuiKey_Tab);
  touch_again();
  const std::vector<Sample> second = last_contact();
  ASSERT_EQ(traces().size(), 1U);
  EXPECT_EQ(traces().front().label, label);
  const draw::SampleHistory& ghost = *traces().front().history;
  ASSERT_GT(ghost.size(), 1000U);
  for (std::size_t i = 0; i < 1000; ++i) {
    const Sample point = ghost.sample(i);
    ASSERT_EQ(point.tick, second[i].tick);
    ASSERT_DOUBLE_EQ(point.time_s, second[i].time_s);
    ASSERT_EQ(point.position_m, first[i].position_m);
    ASSERT_EQ(point.force_n, first[i].force_n);
    ASSERT_EQ(point.stiffness_n_per_m, first[i].stiffness_n_per_m);
  }
  // The energies begin where the present contact's do.
  EXPECT_NEAR(ghost.sample(0).energy_cv_j, second[0].energy_cv_j, 0.01);
  EXPECT_NEAR(ghost.sample(999).energy_scv_j - ghost.sample(0).energy_scv_j,
              first[999].energy_scv_j - first[0].energy_scv_j, 1e-12);
  EXPECT_TRUE(sees(label));
}

TEST_F(ComparePanelTest, GhostsCanBeSwitchedOffAndGoWithTheSession) {
  live(3000);
  press(ImGuiKey_Tab);
  touch_again();
  ASSERT_EQ(traces().size(), 1U);
  click("ghost");
  EXPECT_TRUE(traces().empty());
  click("ghost");
  EXPECT_EQ(traces().size(), 1U);
  click_figure("Figure 5");
  EXPECT_TRUE(traces().empty());
}

}  // namespace
}  // namespace hapticwall::test
