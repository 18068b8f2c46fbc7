// The table of keys: unique chords, names, and dispatch.
#include "app/ui/window/keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/ui/state/appearance.h"
#include "app/ui/window/window_layout.h"
#include "core/algorithm/algorithm.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using ui::KeyBinding;

class KeysTest : public GuiTest {};

TEST_F(KeysTest, NoChordHasTwoMeanings) {
  std::map<ImGuiKeyChord, std::string> taken;
  for (const KeyBinding& binding : ui::key_bindings()) {
    for (const auto& chords : {binding.chords, binding.more}) {
      for (const ImGuiKeyChord chord : chords) {
        const auto [place, is_new] = taken.emplace(chord, binding.what);
        EXPECT_TRUE(is_new) << place->second << " and " << binding.what;
      }
    }
    EXPECT_FALSE(binding.what.empty());
    EXPECT_FALSE(binding.chords.empty()) << "the help would name no key: " << binding.what;
    EXPECT_TRUE(binding.act);
  }
}

TEST_F(KeysTest, TheFirstAlwaysTakesTheForceAway) {
  const KeyBinding& first = ui::key_bindings().front();
  EXPECT_EQ(first.chords, std::vector<ImGuiKeyChord>{ImGuiKey_Space});
  EXPECT_TRUE(first.always);
  for (const KeyBinding& binding : ui::key_bindings())
    EXPECT_EQ(binding.always, &binding == &first) << binding.what;

  const auto stops = [&](ImGuiKeyChord modifier = 0) {
    const std::size_t before = fake_->arm_requests.size();
    press(modifier | ImGuiKey_Space);
    return fake_->arm_requests.size() == before + 1 && !fake_->arm_requests.back();
  };
  EXPECT_TRUE(stops());
  press(ImGuiKey_F1);
  EXPECT_TRUE(stops()) << "help is open";
  press(ImGuiKey_F1);
  click("scene");
  EXPECT_TRUE(stops()) << "a list is open";
  press(ImGuiKey_Escape);
  click("stiffness");
  EXPECT_TRUE(ImGui::GetIO().WantTextInput);
  EXPECT_TRUE(stops()) << "a text is typed";
  press(ImGuiKey_Escape);
  for (const ImGuiKeyChord modifier : {ImGuiMod_Ctrl, ImGuiMod_Shift, ImGuiMod_Alt})
    EXPECT_TRUE(stops(modifier)) << "a modifier key is held down";
}

// Counting bindings with the same keys: each chord triggers its own binding once.
TEST_F(KeysTest, EveryChordReachesItsOwnBinding) {
  std::vector<KeyBinding> counting = ui::key_bindings();
  std::map<std::string, int> counts;
  for (KeyBinding& binding : counting) {
    binding.repeats = false;
    binding.act = [&counts, what = binding.what](const ui::PanelContext&) { ++counts[what]; };
  }
  session::Snapshot snapshot = fake_->snapshot();
  const draw::Theme theme;
  const ui::PanelContext context =
      ui::context_of(state(), *fake_, snapshot, theme, {.live = fake_});
  const auto frame = [&] {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    ui::handle_keys(context, counting);
    ImGui::Render();
  };
  for (const KeyBinding& binding : counting) {
    for (const auto& chords : {binding.chords, binding.more}) {
      for (const ImGuiKeyChord chord : chords) {
        counts.clear();
        ImGuiIO& io = ImGui::GetIO();
        for (const ImGuiKey modifier : {ImGuiMod_Ctrl, ImGuiMod_Shift})
          io.AddKeyEvent(modifier, (chord & modifier) != 0);
        frame();
        io.AddKeyEvent(static_cast<ImGuiKey>(chord & ~ImGuiMod_Mask_), true);
        frame();
        frame();
        io.AddKeyEvent(static_cast<ImGuiKey>(chord & ~ImGuiMod_Mask_), false);
        frame();
        EXPECT_EQ(counts, (std::map<std::string, int>{{binding.what, 1}})) << binding.what;
      }
    }
  }
}

TEST_F(KeysTest, TheNamesOfKeysAreThoseOfTheKeyboard) {
  std::set<std::string> names;
  for (const KeyBinding& binding : ui::key_bindings()) names.insert(ui::keys_text(binding));
  EXPECT_FALSE(names.contains(""));
  for (const char* name : {"Space", "P", "S or →", "1", "Ctrl+Z", "Ctrl+Shift+Z or Ctrl+Y",
                           "F1 or ?", "Esc", "Ctrl and +"})
    EXPECT_TRUE(names.contains(name)) << name;
}

TEST_F(KeysTest, BracketsChangeTheSlowMotionOfASimulatorStepByStep) {
  press(ImGuiKey_RightBracket);
  EXPECT_EQ(fake_->periods_per_tick, 1U) << "no faster than full speed";
  for (const std::uint32_t periods : {2U, 5U, 10U}) {
    press(ImGuiKey_LeftBracket);
    EXPECT_EQ(fake_->periods_per_tick, periods);
  }
  press(ImGuiKey_RightBracket);
  EXPECT_EQ(fake_->periods_per_tick, 5U);
  click("slow motion");
  click("slow motion 1000");
  EXPECT_EQ(fake_->periods_per_tick, 1000U);
  press(ImGuiKey_LeftBracket);
  EXPECT_EQ(fake_->periods_per_tick, 1000U);
}

TEST_F(KeysTest, ALetterWithCtrlIsNotTheLetter) {
  press(ImGuiMod_Ctrl | ImGuiKey_A);
  EXPECT_TRUE(fake_->arm_requests.empty());
  press(ImGuiMod_Ctrl | ImGuiKey_P);
  EXPECT_FALSE(fake_->is_paused);
  press(ImGuiMod_Shift | ImGuiKey_P);
  EXPECT_TRUE(fake_->is_paused);
}

// Walks with the arrows. A slider is the pointer's way to its field; plots, their legends and the
// views take the pointer only.
// A control under the cursor of the keyboard, and what Dear ImGui needs to put the cursor back.
struct Spot {
  ImGuiWindow* window;
  ImGuiID id;
  ImGuiNavLayer layer;
  ImGuiID scope;
  ImRect place;
};

Spot present_spot() {
  const ImGuiContext& context = *ImGui::GetCurrentContext();
  return {context.NavWindow, context.NavId, context.NavLayer, context.NavFocusScopeId,
          context.NavWindow->NavRectRel[context.NavLayer]};
}

// All controls to which arrows lead from the present one: from each control that was reached, every
// arrow is tried once.
class ArrowWalk {
 public:
  explicit ArrowWalk(std::function<void(int)> frames) : frames_(std::move(frames)) {}

  void walk() {
    note();
    for (; next_ < spots_.size(); ++next_) {
      for (const ImGuiKey way :
           {ImGuiKey_DownArrow, ImGuiKey_UpArrow, ImGuiKey_RightArrow, ImGuiKey_LeftArrow}) {
        go_to(Spot(spots_[next_]));
        step(way);
        note();
      }
    }
  }
  [[nodiscard]] bool reached(ImGuiID id) const { return ids_.contains(id); }

 private:
  void note() {
    const Spot spot = present_spot();
    if (spot.id != 0 && ids_.insert(spot.id).second) spots_.push_back(spot);
  }
  void go_to(const Spot& spot) {
    ImGui::FocusWindow(spot.window);
    ImGui::SetNavID(spot.id, spot.layer, spot.scope, spot.place);
    ImGui::SetNavCursorVisible(true);  // as Alt does
    frames_(1);
  }
  void step(ImGuiKey way) {
    ImGui::GetIO().AddKeyEvent(way, true);
    frames_(1);
    ImGui::GetIO().AddKeyEvent(way, false);
    frames_(1);
  }

  std::function<void(int)> frames_;
  std::set<ImGuiID> ids_;
  std::vector<Spot> spots_;  // in the order in which they were reached
  std::size_t next_ = 0;     // the first one whose arrows were not tried
};

TEST_F(KeysTest, TheArrowsReachTheControls) {
  live(100);  // there is something to export
  const Items usual = drawn_items();
  ArrowWalk arrows([&](int count) { frames(count); });
  ImGui::GetIO().AddKeyEvent(ImGuiKey_DownArrow, true);
  frames(1);
  ImGui::GetIO().AddKeyEvent(ImGuiKey_DownArrow, false);
  frames(1);
  arrows.walk();
  press(ImGuiMod_Alt | ImGuiKey_LeftAlt);  // moves to the tabs
  arrows.walk();
  // The scene omits the last two.
  const std::set<std::string> disabled{
      "undo", "redo", "step", "automatic axes", "sampling.render_every", "sampling.lost_ticks"};
  const std::set<std::string> for_the_pointer{"wall view", "magnifier", "status"};
  // The walk folds their section by ←.
  const std::set<std::string> folded{"slot A", "slot B", "take B", "ghost"};
  for (const auto& [name, item] : usual) {
    const bool pointed = name.starts_with("legend ") || name.ends_with("-slider") ||
                         name.starts_with("gap ") || for_the_pointer.contains(name);
    if (item.id == 0 || pointed || disabled.contains(name) || folded.contains(name)) continue;
    EXPECT_TRUE(arrows.reached(item.id)) << name;
  }
  EXPECT_EQ(fake_->steps, 0) << "the arrows navigate";
}

TEST_F(KeysTest, TheRightArrowGoesFromASlotToItsButton) {
  click("slot A");
  ImGui::SetNavCursorVisible(true);  // as Alt does
  press(ImGuiKey_DownArrow);
  EXPECT_EQ(ImGui::GetCurrentContext()->NavId, rect("slot B").id);
  press(ImGuiKey_RightArrow);
  EXPECT_EQ(ImGui::GetCurrentContext()->NavId, rect("take B").id);
}

TEST_F(KeysTest, TheRightArrowGoesFromTheCursorsToTheExports) {
  live(100);  // there is something to export
  for (const float width : {1024.0F, 1280.0F, 1920.0F, 2560.0F}) {
    ImGui::GetIO().DisplaySize.x = width;
    frames(3);
    click("cursors");
    ImGui::SetNavCursorVisible(true);  // as Alt does
    // The first press shows where the keyboard is.
    for (const char* next : {"cursors", "export csv", "export png"}) {
      press(ImGuiKey_RightArrow);
      EXPECT_EQ(ImGui::GetCurrentContext()->NavId, rect(next).id) << next << " at " << width;
    }
  }
}

TEST_F(KeysTest, SpacePressesNothingWhereTheKeyboardIs) {
  press(ImGuiKey_DownArrow);
  ASSERT_TRUE(ImGui::GetIO().NavVisible);
  const std::size_t before = fake_->arm_requests.size();
  const auto algorithm = scene().algorithm.index;
  for (int i = 0; i < 8; ++i) {
    press(ImGuiKey_Space);
    press(ImGuiKey_DownArrow);
  }
  EXPECT_EQ(fake_->arm_requests.size(), before + 8);
  EXPECT_EQ(scene().algorithm.index, algorithm);
  EXPECT_FALSE(ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup));
  EXPECT_FALSE(state().window.help_shown);
}

// Ctrl goes up before R does, within one frame.
TEST_F(KeysTest, AFastCtrlRIsNeverR) {
  ImGuiIO& io = ImGui::GetIO();
  io.AddKeyEvent(ImGuiMod_Ctrl, true);
  frames(2);
  io.AddKeyEvent(ImGuiKey_R, true);
  application_->press({ImGui::GetCurrentContext()->InputEventsQueue.back().EventId, ImGuiMod_Ctrl});
  io.AddKeyEvent(ImGuiMod_Ctrl, false);
  io.AddKeyEvent(ImGuiKey_R, false);
  frames(4);
  EXPECT_EQ(fake_->resets, 0);
  EXPECT_EQ(fake_->recording_status().state, session::RecordingState::kRecording);
  EXPECT_TRUE(state().input.key_presses.empty());
}

TEST_F(KeysTest, ResetAsksWhileItRecords) {
  const auto recording = [this] { return fake_->recording_status().state; };
  press(ImGuiMod_Ctrl | ImGuiKey_R);
  press(ImGuiKey_R);
  EXPECT_EQ(fake_->resets, 0);
  EXPECT_TRUE(sees("agree to reset"));
  press(ImGuiKey_Escape);
  EXPECT_FALSE(sees("agree to reset"));
  EXPECT_EQ(recording(), session::RecordingState::kRecording);
  press(ImGuiKey_R);
  click("go on recording");
  EXPECT_EQ(fake_->resets, 0);
  click("reset");
  click("agree to reset");
  EXPECT_EQ(fake_->resets, 1);
  EXPECT_FALSE(sees("agree to reset"));
  press(ImGuiKey_R);
  press(ImGuiKey_R);
  EXPECT_EQ(fake_->resets, 2) << "the second time agrees";
  press(ImGuiMod_Ctrl | ImGuiKey_R);
  press(ImGuiKey_R);
  EXPECT_EQ(fake_->resets, 3) << "nothing is recorded";
}

TEST_F(KeysTest, TheKeysOfTheForceSayWhatTheyDoWithoutADevice) {
  for (const ImGuiKey key : {ImGuiKey_Space, ImGuiKey_A}) {
    press(key);
    EXPECT_THAT(message().text, ::testing::HasSubstr("none is connected"));
    press(ImGuiKey_Escape);
  }
  fake_->info.is_simulated = false;
  press(ImGuiKey_Space);
  EXPECT_THAT(message().text, ::testing::Not(::testing::HasSubstr("none is connected")));
}

}  // namespace
}  // namespace hapticwall::test
