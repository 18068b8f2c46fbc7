// Every key of the help has its effect. The keys of the force are tested on a device.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "app/ui/panel/layout_choice.h"
#include "app/ui/state/appearance.h"
#include "app/ui/state/comparing.h"
#include "app/ui/window/keys.h"
#include "core/algorithm/algorithm.h"
#include "tests/window/deeds.h"
#include "tests/window/window_test.h"

namespace hapticwall::test {
namespace {

using ui::KeyBinding;
using ui::KeyGroup;

// One line of the help.
struct KeyRow {
  std::string what;
  // Lets `press` press the key, and checks the effect.
  std::function<void(Person&, const Act& press)> check;
};

KeyRow key_flips(std::string what, Look look) {
  return {std::move(what), [look = std::move(look)](Person& person, const Act& press) {
            flip_twice(person, look, press);
          }};
}

KeyRow chooses_algorithm(std::size_t index) {
  return {std::string(algorithms()[index].name), [index](Person& person, const Act& press) {
            person.click(std::string(algorithms()[index == 0 ? 1 : 0].name));
            press();
            EXPECT_EQ(person.scene().algorithm.index, index);
          }};
}

void scale(Person& person, const Act& press, int way) {
  const int before = ui::scale_percent_in_force(person.state().appearance);
  press();
  EXPECT_GT(way * (ui::scale_percent_in_force(person.state().appearance) - before), 0);
  ui::set_scale(person.state().appearance, 0);
  person.wait_a_frame();
}

void scale_as_screen(Person& person, const Act& press) {
  ui::set_scale(person.state().appearance, 110);
  person.wait_a_frame();
  press();
  EXPECT_EQ(person.state().appearance.scale_percent, 0);
}

// A list goes first, then the help, then a message.
void put_away(Person& person, const Act& press) {
  person.state().toasts.tell(ui::MessageKind::kProblem, "a problem");
  person.click("help");
  EXPECT_TRUE(person.state().window.help_shown);
  press();
  EXPECT_FALSE(person.state().window.help_shown);
  EXPECT_EQ(person.message().text, "a problem");
  person.click("time window");
  press();
  EXPECT_FALSE(ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup));
  EXPECT_EQ(person.message().text, "a problem");
  press();
  EXPECT_NE(person.message().text, "a problem");
}

void next_trigger(Person& person, const Act& press) {
  using enum draw::TriggerMode;
  const auto mode = [&] { return person.state().plots.persisted.trigger.mode; };
  EXPECT_EQ(mode(), kOff);
  for (const draw::TriggerMode next : {kAuto, kNormal, kSingle, kOff}) {
    press();
    EXPECT_EQ(mode(), next);
  }
}

// ---- with a recording open

session::ReplaySession& replay(Person& person) { return *person.replay(); }

std::uint64_t tick(Person& person) { return person.session().snapshot().newest.x().tick; }

KeyRow in_replay(std::string what, std::function<void(Person&, const Act&)> check) {
  return {std::move(what), [check = std::move(check)](Person& person, const Act& press) {
            open_a_recording(person);
            replay(person).pause(true);
            person.wait_a_frame();
            check(person, press);
            back_to_the_scene(person);
          }};
}

void step_back(Person& person, const Act& press) {
  replay(person).seek(replay(person).end_s());
  person.wait_a_frame();
  const std::uint64_t before = tick(person);
  press();
  EXPECT_LT(tick(person), before);
}

// Changes the speed of the simulator, from 1/2 to 1/`after`, and of a recording.
void change_speed(Person& person, const Act& press, std::uint32_t after, double way) {
  const auto periods = [&] { return person.session().snapshot().periods_per_tick; };
  person.live().slow_down(2);
  person.wait_until([&] { return periods() == 2; }, "slow motion");
  press();
  person.wait_until([&] { return periods() == after; }, "the next slow motion");
  person.live().slow_down(1);
  open_a_recording(person);
  replay(person).set_speed(1.0);
  press();
  EXPECT_GT(way * (replay(person).speed() - 1.0), 0.0);
  back_to_the_scene(person);
}

void go_to_mark(Person& person, const Act& press, double from_s, const file::Mark& mark) {
  replay(person).seek(from_s);
  person.wait_a_frame();
  press();
  EXPECT_EQ(tick(person), mark.tick);
}

void next_layout(Person& person, const Act& press) {
  const std::string& now = person.state().dock.layout;
  for (const ui::BuiltinLayout& each : ui::builtin_layouts()) {
    EXPECT_EQ(now, each.name);
    press();
  }
  EXPECT_EQ(now, ui::builtin_layouts().front().name);
}

void withdraw(Person& person, const Act& press) {
  person.state().hand.led = false;
  press();
  EXPECT_TRUE(person.state().hand.led);
}

std::vector<KeyRow> key_rows() {
  std::vector<KeyRow> rows{
      {"pause, or run on", pause_and_run},
      {"one tick, while paused", step_once},
      {"reset: back to tick 0, at rest", reset_once},
      {"withdraw the hand from the wall", withdraw},
      {"record, or stop recording", record_and_stop},
      {"mark this moment of the recording, then name it",
       [](Person& p, const Act& press) { set_marks(p, press); }},
      key_flips(
          "slot A or B of Compare; in a field: the next field",
          [](Person& p) { return static_cast<double>(ui::slots_of(p.state().compare).active); }),
      {"undo the last change", undo_once},
      {"redo it", redo_once},
      key_flips("this help", [](Person& p) { return p.state().window.help_shown ? 1.0 : 0.0; }),
      key_flips("dark or light",
                [](Person& p) { return static_cast<double>(p.state().appearance.look); }),
      {"next layout of the windows", next_layout},
      key_flips("state of the loop",
                [](Person& p) { return p.state().window.status_shown ? 1.0 : 0.0; }),
      {"everything larger", [](Person& p, const Act& press) { scale(p, press, 1); }},
      {"everything smaller", [](Person& p, const Act& press) { scale(p, press, -1); }},
      {"scale of the screen", scale_as_screen},
      key_flips("present to a room, or not",
                [](Person& p) { return p.state().window.presents ? 1.0 : 0.0; }),
      {"close a list, help, presentation, or the newest message", put_away},
      key_flips("follow the newest samples, or freeze",
                [](Person& p) { return p.state().time.follow ? 1.0 : 0.0; }),
      {"the next kind of trigger", next_trigger},
      key_flips("show or hide the cursors",
                [](Person& p) { return p.state().plots.transient.cursors.shown ? 1.0 : 0.0; }),
      in_replay("one tick back, while paused", step_back),
      {"slower: slow motion", [](Person& p, const Act& press) { change_speed(p, press, 5, -1.0); }},
      {"faster", [](Person& p, const Act& press) { change_speed(p, press, 1, 1.0); }},
      in_replay("begin anew at the end, or not",
                [](Person& p, const Act& press) {
                  const bool before = replay(p).loops();
                  press();
                  EXPECT_NE(replay(p).loops(), before);
                }),
      in_replay("to the mark before",
                [](Person& p, const Act& press) {
                  go_to_mark(p, press, replay(p).end_s(), p.session().marks().back());
                }),
      in_replay("to the next mark", [](Person& p, const Act& press) {
        go_to_mark(p, press, replay(p).begin_s(), p.session().marks().front());
      })};
  for (std::size_t i = 0; i < algorithms().size(); ++i) rows.push_back(chooses_algorithm(i));
  return rows;
}

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

TEST_F(KeysWindowTest, EveryKeyDoesWhatItSays) {
  use([](Person& person) {
    const std::vector<KeyRow> rows = key_rows();
    for (const KeyBinding& binding : ui::key_bindings()) {
      if (binding.group == KeyGroup::kForce || person.is_stuck()) continue;
      SCOPED_TRACE(ui::keys_text(binding) + ": " + binding.what);
      const auto row = std::find_if(rows.begin(), rows.end(), [&](const KeyRow& candidate) {
        return candidate.what == binding.what;
      });
      if (row == rows.end()) {
        ADD_FAILURE() << "no row checks it; add one to key_rows()";
        continue;
      }
      for (const auto& press : ways_to_press(person, binding)) {
        person.put_everything_away();
        row->check(person, press);
      }
    }
  });
}

TEST_F(KeysWindowTest, TheForceKeysReachTheDevice) {
  connect_device();
  use([this](Person& person) {
    const KeyBinding& off = binding_of(KeyGroup::kForce, 0);
    const KeyBinding& on = binding_of(KeyGroup::kForce, 1);
    for (const auto& press : ways_to_press(person, on)) press();
    EXPECT_EQ(device().arm_requests, std::vector{true});
    for (const auto& press : ways_to_press(person, off)) press();
    EXPECT_EQ(device().arm_requests, (std::vector{true, false}));
    EXPECT_EQ(std::count_if(ui::key_bindings().begin(), ui::key_bindings().end(),
                            [](const KeyBinding& key) { return key.group == KeyGroup::kForce; }),
              2)
        << "a new key of the force needs its checks here";
  });
}

TEST_F(KeysWindowTest, LettersTypedIntoAFieldAreNoKeys) {
  use([](Person& person) {
    const std::size_t before = person.scene().algorithm.index;
    person.click("recording name");
    for (const ImGuiKey key : {ImGuiKey_A, ImGuiKey_P, ImGuiKey_F, ImGuiKey_C, ImGuiKey_T,
                               ImGuiKey_1, ImGuiKey_2, ImGuiKey_3, ImGuiKey_R})
      person.press(key);
    person.write("apfct123r");
    EXPECT_EQ(person.scene().algorithm.index, before);
    EXPECT_FALSE(person.session().snapshot().paused);
    EXPECT_TRUE(person.state().time.follow);
    EXPECT_FALSE(person.state().plots.transient.cursors.shown);
    EXPECT_EQ(person.state().plots.persisted.trigger.mode, draw::TriggerMode::kOff);
    EXPECT_EQ(person.session().snapshot().resets, 0U);
    person.press(ImGuiKey_Enter);
    EXPECT_EQ(person.state().recording.name, "apfct123r");
  });
}

}  // namespace
}  // namespace hapticwall::test
