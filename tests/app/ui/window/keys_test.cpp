// The table of keys: unique chords, names, and dispatch.
#include "app/ui/window/keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>
#include <set>

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
TEST_F(KeysTest, TheArrowsReachTheControls) {
  std::set<ImGuiID> reached;
  const auto step = [&](ImGuiKey way) {
    ImGui::GetIO().AddKeyEvent(way, true);
    frames(1);
    ImGui::GetIO().AddKeyEvent(way, false);
    frames(1);
    reached.insert(ImGui::GetCurrentContext()->NavId);
  };
  live(100);  // there is something to export
  const Items usual = drawn_items();
  std::mt19937 random(4);
  constexpr std::array kWays{ImGuiKey_DownArrow, ImGuiKey_UpArrow, ImGuiKey_RightArrow,
                             ImGuiKey_LeftArrow};
  ImGuiKey way = ImGuiKey_DownArrow;
  for (int i = 0; i < 3000; ++i) {
    if (random() % 6 == 0) way = kWays.at(i == 0 ? 0 : random() % kWays.size());
    step(way);
  }
  for (const char* row : {"follow", "magnify less", "cursors", "page Plots"}) {
    click(row);
    ImGui::SetNavCursorVisible(true);  // as Alt does
    for (int i = 0; i < 10; ++i) step(ImGuiKey_RightArrow);
    for (int i = 0; i < 14; ++i) step(ImGuiKey_LeftArrow);
    for (int i = 0; i < 14; ++i) step(ImGuiKey_UpArrow);
    for (int i = 0; i < 12; ++i) step(ImGuiKey_RightArrow);
  }
  press(ImGuiMod_Alt | ImGuiKey_LeftAlt);  // moves to the tabs
  for (const ImGuiKey along : {ImGuiKey_RightArrow, ImGuiKey_LeftArrow}) {
    for (int i = 0; i < 8; ++i) step(along);
  }
  const std::set<std::string> disabled{"undo", "redo", "step", "automatic axes"};
  const std::set<std::string> for_the_pointer{"wall view", "magnifier"};
  for (const auto& [name, item] : usual) {
    const bool pointed = name.starts_with("legend ") || name.ends_with("-slider") ||
                         name.starts_with("gap ") || for_the_pointer.contains(name);
    if (item.id == 0 || pointed || disabled.contains(name)) continue;
    EXPECT_TRUE(reached.contains(item.id)) << name;
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
