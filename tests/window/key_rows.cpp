#include "tests/window/key_rows.h"

#include <gtest/gtest.h>

#include <utility>

#include "app/ui/state/appearance.h"
#include "app/ui/state/comparing.h"
#include "core/stabiliser/stabiliser.h"
#include "tests/window/recordings.h"

namespace hapticwall::test {
namespace {

using Press = std::function<void()>;
using Look = std::function<double(Person&)>;

// Pressed twice it is as before.
KeyRow key_flips(std::string what, Look look) {
  return {std::move(what), [look = std::move(look)](Person& person, const Press& press) {
            const double before = look(person);
            press();
            EXPECT_NE(look(person), before);
            press();
            EXPECT_EQ(look(person), before);
          }};
}

bool is_paused(Person& person) { return person.session().snapshot().paused; }

void pause(Person& person, const Press& press) {
  for (const bool paused : {true, false}) {
    press();
    person.wait_until([&] { return is_paused(person) == paused; }, "pause");
  }
}

void step(Person& person, const Press& press) {
  person.session().pause(true);
  person.wait_until([&] { return is_paused(person); }, "pause");
  person.wait_a_frame();
  const std::uint64_t before = person.session().snapshot().newest.x().tick;
  press();
  person.wait_until([&] { return person.session().snapshot().newest.x().tick > before; }, "a tick");
  EXPECT_EQ(person.session().snapshot().newest.x().tick, before + 1);
  person.session().pause(false);
  person.wait_until([&] { return !is_paused(person); }, "running");
}

void reset(Person& person, const Press& press) {
  const std::uint32_t before = person.session().snapshot().resets;
  press();
  person.wait_until([&] { return person.session().snapshot().resets == before + 1; }, "the reset");
}

void record(Person& person, const Press& press) {
  press();
  EXPECT_EQ(person.recording().state, runtime::RecordingState::kRecording);
  person.wait_until([&] { return person.recording().rows > 0; }, "rows");
  press();
  EXPECT_EQ(person.recording().state, runtime::RecordingState::kIdle);
}

std::size_t algorithm(Person& person) { return person.scene().algorithm.index; }

void set_algorithm(Person& person, std::size_t index) {
  AlgorithmSettings settings = person.scene().algorithm;
  settings.index = index;
  EXPECT_FALSE(person.live().set_algorithm(settings));
  person.wait_a_frame();
}

KeyRow chooses(std::size_t index) {
  return {std::string(algorithms()[index].name), [index](Person& person, const Press& press) {
            set_algorithm(person, index == 0 ? 1 : 0);
            press();
            EXPECT_EQ(algorithm(person), index);
          }};
}

void undo(Person& person, const Press& press) {
  set_algorithm(person, 0);
  set_algorithm(person, 1);
  press();
  EXPECT_EQ(algorithm(person), 0U);
}

void redo(Person& person, const Press& press) {
  set_algorithm(person, 0);
  set_algorithm(person, 1);
  person.click("undo");
  EXPECT_EQ(algorithm(person), 0U);
  press();
  EXPECT_EQ(algorithm(person), 1U);
}

int percent(Person& person) { return ui::scale_percent_in_force(person.state()); }

void scale(Person& person, const Press& press, int way) {
  const int before = percent(person);
  press();
  EXPECT_GT(way * (percent(person) - before), 0);
  ui::set_scale(person.state(), 0);
  person.wait_a_frame();
}

void scale_as_screen(Person& person, const Press& press) {
  ui::set_scale(person.state(), 110);
  person.wait_a_frame();
  press();
  EXPECT_EQ(person.state().persisted.scale_percent, 0);
}

// The topmost of what is open goes first.
void put_away(Person& person, const Press& press) {
  ui::tell(person.state(), ui::MessageKind::kProblem, "a problem");
  person.click("help");
  EXPECT_TRUE(person.state().transient.help_shown);
  press();
  EXPECT_FALSE(person.state().transient.help_shown);
  EXPECT_EQ(person.message().text, "a problem");
  person.click("time window");
  press();
  EXPECT_FALSE(ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup));
  EXPECT_EQ(person.message().text, "a problem");
  press();
  EXPECT_NE(person.message().text, "a problem");
}

void next_trigger(Person& person, const Press& press) {
  using enum draw::TriggerMode;
  const auto mode = [&] { return person.state().plots.persisted.trigger.mode; };
  EXPECT_EQ(mode(), kOff);
  for (const draw::TriggerMode next : {kAuto, kNormal, kSingle, kOff}) {
    press();
    EXPECT_EQ(mode(), next);
  }
}

std::vector<KeyRow> window_key_rows() {
  return {
      key_flips("this help", [](Person& p) { return p.state().transient.help_shown ? 1.0 : 0.0; }),
      key_flips("dark or light",
                [](Person& p) { return static_cast<double>(p.state().persisted.look); }),
      {"everything larger", [](Person& p, const Press& press) { scale(p, press, 1); }},
      {"everything smaller", [](Person& p, const Press& press) { scale(p, press, -1); }},
      {"as large as the screen says", scale_as_screen},
      {"close a list, the help, or the newest message", put_away},
      key_flips("follow the newest samples, or freeze",
                [](Person& p) { return p.state().transient.follow ? 1.0 : 0.0; }),
      {"the next kind of trigger", next_trigger},
      key_flips("show or hide the cursors",
                [](Person& p) { return p.state().plots.transient.cursors.shown ? 1.0 : 0.0; })};
}

// ---- with a recording open

runtime::ReplaySession& replay(Person& person) { return *person.replay(); }

KeyRow in_replay(std::string what, std::function<void(Person&, const Press&)> check) {
  return {std::move(what), [check = std::move(check)](Person& person, const Press& press) {
            open_a_recording(person);
            replay(person).pause(true);
            person.wait_a_frame();
            check(person, press);
            back_to_the_scene(person);
          }};
}

void step_back(Person& person, const Press& press) {
  replay(person).seek(replay(person).end_s());
  person.wait_a_frame();
  const std::uint64_t before = person.session().snapshot().newest.x().tick;
  press();
  EXPECT_LT(person.session().snapshot().newest.x().tick, before);
}

void change_speed(Person& person, const Press& press, double way) {
  replay(person).set_speed(1.0);
  press();
  EXPECT_GT(way * (replay(person).speed() - 1.0), 0.0);
}

void go_to_mark(Person& person, const Press& press, double from_s, std::uint64_t tick) {
  replay(person).seek(from_s);
  person.wait_a_frame();
  press();
  EXPECT_EQ(person.session().snapshot().newest.x().tick, tick);
}

std::vector<KeyRow> replay_key_rows() {
  return {in_replay("one tick back, while paused", step_back),
          in_replay("slower", [](Person& p, const Press& press) { change_speed(p, press, -1.0); }),
          in_replay("faster", [](Person& p, const Press& press) { change_speed(p, press, 1.0); }),
          in_replay("begin anew at the end, or not",
                    [](Person& p, const Press& press) {
                      const bool before = replay(p).loops();
                      press();
                      EXPECT_NE(replay(p).loops(), before);
                    }),
          in_replay("to the mark before",
                    [](Person& p, const Press& press) {
                      go_to_mark(p, press, replay(p).end_s(), p.session().marks().back().tick);
                    }),
          in_replay("to the next mark", [](Person& p, const Press& press) {
            go_to_mark(p, press, replay(p).begin_s(), p.session().marks().front().tick);
          })};
}

void mark(Person& person, const Press& press) {
  person.click("record");
  person.wait_until([&] { return person.recording().rows > 0; }, "rows");
  person.put_everything_away();
  const std::size_t before = person.session().marks().size();
  press();
  EXPECT_EQ(person.session().marks().size(), before + 1);
  person.click("record");
}

double active_slot(Person& person) {
  return static_cast<double>(ui::slots_of(person.state()).active);
}

}  // namespace

std::vector<KeyRow> key_rows() {
  std::vector<KeyRow> rows{
      {"pause, or run on", pause},
      {"one tick, while paused", step},
      {"reset: back to tick 0, at rest", reset},
      {"record, or stop recording", record},
      {"mark this moment in the recording", mark},
      key_flips("slot A or B of Compare; in a field: the next field", active_slot),
      {"undo the last change", undo},
      {"redo it", redo}};
  for (std::size_t i = 0; i < algorithms().size(); ++i) rows.push_back(chooses(i));
  for (KeyRow& row : window_key_rows()) rows.push_back(std::move(row));
  for (KeyRow& row : replay_key_rows()) rows.push_back(std::move(row));
  return rows;
}

}  // namespace hapticwall::test
