// Every key does once what the help says.
#include "app/ui/window/keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "app/ui/state/appearance.h"
#include "app/ui/window/window_layout.h"
#include "core/stabiliser/stabiliser.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using ui::KeyBinding;

class KeysTest : public GuiTest {
 protected:
  void press_chord(ImGuiKeyChord chord) {
    ImGuiIO& io = ImGui::GetIO();
    const auto modifiers = {ImGuiMod_Ctrl, ImGuiMod_Shift, ImGuiMod_Alt};
    for (const ImGuiKey modifier : modifiers) {
      if ((chord & modifier) != 0) io.AddKeyEvent(modifier, true);
    }
    press(static_cast<ImGuiKey>(chord & ~ImGuiMod_Mask_));
    for (const ImGuiKey modifier : modifiers) {
      if ((chord & modifier) != 0) io.AddKeyEvent(modifier, false);
    }
    frames(1);
  }
};

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

TEST_F(KeysTest, TheFirstTakesTheForceAwayWhateverElseIsGoingOn) {
  const KeyBinding& first = ui::key_bindings().front();
  EXPECT_EQ(first.chords, std::vector<ImGuiKeyChord>{ImGuiKey_Space});
  EXPECT_TRUE(first.always);
  for (const KeyBinding& binding : ui::key_bindings())
    EXPECT_EQ(binding.always, &binding == &first) << binding.what;

  const auto stops = [&] {
    const std::size_t before = fake_->arm_requests.size();
    press(ImGuiKey_Space);
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
  for (const ImGuiKey modifier : {ImGuiMod_Ctrl, ImGuiMod_Shift, ImGuiMod_Alt}) {
    ImGui::GetIO().AddKeyEvent(modifier, true);
    EXPECT_TRUE(stops()) << "something else is held down";
    ImGui::GetIO().AddKeyEvent(modifier, false);
    frames(1);
  }
}

// Counting bindings with the same keys: each chord triggers its own binding once.
TEST_F(KeysTest, EveryChordReachesItsOwnBinding) {
  std::vector<KeyBinding> counting = ui::key_bindings();
  std::map<std::string, int> counts;
  for (KeyBinding& binding : counting) {
    binding.repeats = false;
    binding.act = [&counts, what = binding.what](const ui::PanelContext&) { ++counts[what]; };
  }
  runtime::Snapshot snapshot = fake_->snapshot();
  const draw::Theme theme;
  const ui::PanelContext context{*fake_, snapshot, theme, application_->state(), {.live = fake_}};
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

TEST_F(KeysTest, TheHelpShowsEveryBindingAndClosesAgain) {
  EXPECT_FALSE(find("close help").has_value());
  press(ImGuiKey_F1);
  for (const KeyBinding& binding : ui::key_bindings()) {
    EXPECT_TRUE(find(binding.what).has_value()) << binding.what;
    EXPECT_FALSE(ui::keys_text(binding).empty());
  }
  press(ImGuiKey_Escape);
  EXPECT_FALSE(find("close help").has_value());
  ImGui::GetIO().AddInputCharacter('?');
  frames(2);
  EXPECT_TRUE(find("close help").has_value());
  click("close help");
  EXPECT_FALSE(application_->state().transient.help_shown);
  click("help");
  EXPECT_TRUE(application_->state().transient.help_shown);
  move_to(ImVec2(3.0F, 3.0F));  // beside it
  mouse_button(true);
  mouse_button(false);
  EXPECT_FALSE(application_->state().transient.help_shown);
}

TEST_F(KeysTest, TheNamesOfKeysAreThoseOfTheKeyboard) {
  std::set<std::string> names;
  for (const KeyBinding& binding : ui::key_bindings()) names.insert(ui::keys_text(binding));
  for (const char* name : {"Space", "P", "S or →", "1", "Ctrl+Z", "Ctrl+Shift+Z or Ctrl+Y",
                           "F1 or ?", "Esc", "Ctrl and +"})
    EXPECT_TRUE(names.contains(name)) << name;
}

TEST_F(KeysTest, ALetterWithCtrlIsNotTheLetter) {
  press_chord(ImGuiMod_Ctrl | ImGuiKey_A);
  EXPECT_TRUE(fake_->arm_requests.empty());
  press_chord(ImGuiMod_Ctrl | ImGuiKey_P);
  EXPECT_FALSE(fake_->is_paused);
  press_chord(ImGuiMod_Shift | ImGuiKey_P);
  EXPECT_TRUE(fake_->is_paused);
}

}  // namespace
}  // namespace hapticwall::test
