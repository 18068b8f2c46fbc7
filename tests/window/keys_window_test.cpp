// Every key of the help does what the help says; those of a real device's force on a device.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/ui/window/keys.h"
#include "tests/window/key_rows.h"
#include "tests/window/window_test.h"

namespace hapticwall::test {
namespace {

using ui::KeyBinding;
using ui::KeyGroup;

// Every way to press it.
std::vector<std::function<void()>> ways_to_press(Person& person, const KeyBinding& binding) {
  std::vector<std::function<void()>> ways;
  for (const auto& chords : {binding.chords, binding.more}) {
    for (const ImGuiKeyChord chord : chords) ways.emplace_back([&, chord] { person.press(chord); });
  }
  if (binding.character != 0) {
    ways.emplace_back(
        [&, text = std::string(1, static_cast<char>(binding.character))] { person.write(text); });
  }
  return ways;
}

const KeyBinding& binding_of(KeyGroup group, std::size_t index) {
  for (const KeyBinding& binding : ui::key_bindings()) {
    if (binding.group == group && index-- == 0) return binding;
  }
  ADD_FAILURE() << "there is no such key";
  return ui::key_bindings().front();
}

class KeysWindowTest : public WindowTest {};

TEST_P(KeysWindowTest, EveryKeyDoesWhatItSays) {
  use([](Person& person) {
    const std::vector<KeyRow> rows = key_rows();
    for (const KeyBinding& binding : ui::key_bindings()) {
      if (binding.group == KeyGroup::kForce || person.is_stuck()) continue;
      SCOPED_TRACE(ui::keys_text(binding) + ": " + binding.what);
      const auto row = std::find_if(rows.begin(), rows.end(), [&](const KeyRow& candidate) {
        return candidate.what == binding.what;
      });
      if (row == rows.end()) {
        ADD_FAILURE() << "no row says what comes of it; add one to tests/window/key_rows.cpp";
        continue;
      }
      for (const auto& press : ways_to_press(person, binding)) {
        person.put_everything_away();
        row->check(person, press);
      }
    }
  });
}

TEST_P(KeysWindowTest, TheForceKeysReachTheDevice) {
  connect_device();
  use([this](Person& person) {
    const KeyBinding& off = binding_of(KeyGroup::kForce, 0);
    const KeyBinding& on = binding_of(KeyGroup::kForce, 1);
    for (const auto& press : ways_to_press(person, on)) press();
    EXPECT_EQ(device().arm_requests, std::vector{true});
    for (const auto& press : ways_to_press(person, off)) press();
    EXPECT_EQ(device().arm_requests, (std::vector{true, false}));
    // Whatever has the keyboard: a text field, a list, the help.
    person.click("recording name");
    person.press(ImGuiKey_Space);
    person.press(ImGuiKey_Escape);
    person.click("scene");
    person.press(ImGuiKey_Space);
    person.press(ImGuiKey_Escape);
    person.click("help");
    person.press(ImGuiKey_Space);
    EXPECT_EQ(device().arm_requests, (std::vector{true, false, false, false, false}));
    EXPECT_EQ(std::count_if(ui::key_bindings().begin(), ui::key_bindings().end(),
                            [](const KeyBinding& key) { return key.group == KeyGroup::kForce; }),
              2)
        << "a new key of the force needs its lines here";
  });
}

TEST_P(KeysWindowTest, WhatIsTypedIntoAFieldIsNoKey) {
  use([](Person& person) {
    const std::size_t before = person.scene().algorithm.index;
    person.click("recording name");
    for (const ImGuiKey key : {ImGuiKey_A, ImGuiKey_P, ImGuiKey_F, ImGuiKey_C, ImGuiKey_T,
                               ImGuiKey_1, ImGuiKey_2, ImGuiKey_3, ImGuiKey_R})
      person.press(key);
    person.write("apfct123r");
    EXPECT_EQ(person.scene().algorithm.index, before);
    EXPECT_FALSE(person.session().snapshot().paused);
    EXPECT_TRUE(person.state().transient.follow);
    EXPECT_FALSE(person.state().plots.transient.cursors.shown);
    EXPECT_EQ(person.state().plots.persisted.trigger.mode, draw::TriggerMode::kOff);
    EXPECT_EQ(person.session().snapshot().resets, 0U);
    person.press(ImGuiKey_Enter);
    EXPECT_EQ(person.state().transient.recording_name, "apfct123r");
  });
}

HAPTICWALL_ON_BOTH_SCREENS(KeysWindowTest);

}  // namespace
}  // namespace hapticwall::test
