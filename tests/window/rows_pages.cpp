// Identification, the trials of a list, replay, and a scene of two axes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "app/runtime/session/replay_session.h"
#include "app/ui/state/blind_test.h"
#include "tests/window/rows.h"

namespace hapticwall::test {
namespace {

runtime::ReplaySession& replayed(Person& person) { return *person.replay(); }

void go_to_page(Person& person, const char* name) { person.click(std::string("page ") + name); }

// Ends one experiment, and saves the numbers of another one.
void identify_the_device(Person& person) {
  go_to_page(person, "Identify");
  const ui::IdentifyState& identify = person.state().identify;
  const Scene before = person.scene();
  person.type("identify limit", "1.5");
  EXPECT_EQ(identify.choice.limit_n, 1.5);
  person.type("identify travel", "15");
  EXPECT_EQ(identify.choice.travel_m, 0.015);
  person.type("identify seconds", "8");
  EXPECT_EQ(identify.choice.seconds, 8.0);
  person.click("identify start");
  EXPECT_TRUE(identify.experiment);
  person.click("identify end");
  person.wait_until([&] { return !identify.experiment; }, "the end");
  EXPECT_EQ(identify.problem, "the experiment ended with the force off: switched off");
  person.click("identify start");
  person.wait_until([&] { return identify.result.has_value(); }, "the numbers");
  EXPECT_EQ(person.scene(), before);
  person.wait_a_frame();
  person.type("identify name", "mine");
  person.click("identify save");
  EXPECT_TRUE(std::filesystem::exists(person.state().transient.recording_folder + "/mine.toml"))
      << person.message().text;
  person.put_everything_away();
  go_to_page(person, "Plots");
}

void answer(Person& person, const char* choice) {
  person.hover("energy: hidden");
  person.hover("trial …");
  person.click("feel first");
  person.click("feel second");
  person.click(choice);
}

void play_trial_list(Person& person) {
  const ui::BlindTest& test = *person.state().compare.transient.test;
  EXPECT_TRUE(ui::waits(test));
  for (const char* choice : {"choose first", "choose second"}) {
    const std::size_t answered = test.answers.size();
    person.click("go on");
    EXPECT_FALSE(ui::waits(test));
    answer(person, choice);
    EXPECT_EQ(test.answers.size(), answered + 1);
  }
  person.click("stop and show");
  EXPECT_FALSE(test.running);
  for (const char* item : {"answered", "correct", "catch trials", "chose the first", "kind", "A",
                           "B", "chose A", "interval"})
    person.hover(item);
  person.click("new blind test");
  person.click("last result");
}

void move_in_time(Person& person) {
  const double before_s = replayed(person).position_s();
  person.drag_from("time slider", ImVec2(0.1F, 0.5F), ImVec2(40.0F, 0.0F));
  EXPECT_NE(replayed(person).position_s(), before_s);
  person.type("speed", "0.5");
  EXPECT_EQ(replayed(person).speed(), 0.5);
  person.click("speeds");
  const std::vector<std::string> speeds = person.items_called("speed ");
  ASSERT_FALSE(speeds.empty());
  for (const std::string& speed : speeds) {
    if (!person.sees(speed)) person.click("speeds");
    person.click(speed);
    EXPECT_EQ(fmt::format("speed {}x", replayed(person).speed()), speed);
  }
  if (person.sees("more of replay")) {  // in a narrow window
    person.click("more of replay");
    EXPECT_TRUE(ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup));
    person.put_everything_away();
  }
  for (const bool loops : {true, false}) {
    person.click("repeat");
    EXPECT_EQ(replayed(person).loops(), loops);
  }
}

void rerun_under_all(Person& person) {
  person.click("re-run");
  for (const std::string& choice : person.items_called("re-run ")) {
    if (choice == "re-run nothing") continue;
    if (!person.sees(choice)) person.click("re-run");
    person.click(choice);
    person.wait_until([&] { return replayed(person).overlay() != nullptr; }, "the overlay");
    person.wait_a_frame();
    for (const std::string& legend : person.items_called("under ")) person.hover(legend);
  }
  person.click("re-run");
  person.click("re-run nothing");
  EXPECT_EQ(replayed(person).overlay(), nullptr);
}

void use_replay(Person& person) {
  open_a_recording(person);
  move_in_time(person);
  rerun_under_all(person);
  back_to_the_scene(person);
}

void use_corner(Person& person) {
  open_scene(person, "corner");
  for (const char* place : {"wall", "plots"}) {
    person.click(std::string(place) + " axis y");
    EXPECT_EQ(person.state().transient.shown_axis, ui::Axis::kY);
    person.click(std::string(place) + " axis x");
    EXPECT_EQ(person.state().transient.shown_axis, ui::Axis::kX);
  }
  open_scene(person, "layers");
  person.click("wall 3");
  EXPECT_EQ(person.state().transient.chosen_wall, 2U);
  person.click("wall 1");
  open_scene(person, "press");
}

}  // namespace

Table page_rows() { return {{"identify start", identify_the_device}}; }

Table experiment_rows() { return {{"go on", play_trial_list}}; }

Table recording_rows() { return {{"time slider", use_replay}}; }

Table corner_rows() { return {{"wall axis y", use_corner}}; }

}  // namespace hapticwall::test
