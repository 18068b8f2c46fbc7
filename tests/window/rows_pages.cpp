// Pages, Compare, blind test, marks, replay, and a scene of two axes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "app/session/replay_session.h"
#include "app/ui/state/blind_test.h"
#include "app/ui/state/comparing.h"
#include "core/algorithm/algorithm.h"
#include "tests/window/rows.h"

namespace hapticwall::test {
namespace {

using compare::Slot;

session::ReplaySession& replayed(Person& person) { return *person.replay(); }

// `first_item`: the page shows it, and no other page does.
Row page(const char* name, const char* first_item) {
  return does(std::string("page ") + name, [=](Person& person, const Act& click) {
    click();
    person.wait_until([&] { return person.sees(first_item); }, first_item);
    EXPECT_EQ(person.sees("plot Position"), name == std::string(ui::kPlotsPage));
  });
}

void go_to_page(Person& person, const char* name) { person.click(std::string("page ") + name); }

void hover_timing(Person& person) {
  go_to_page(person, "Timing");
  for (const char* item : {"median", "p99", "p99.9", "max", "ticks", "missed ticks",
                           "plot Wake-up latency", "plot Compute time"})
    person.hover(item);
  const std::uint64_t before = person.state().timing.shown.ticks;
  person.wait_until([&] { return person.state().timing.shown.ticks > before + 50; }, "ticks");
  person.click("timing clear");
  person.wait_a_frame();
  EXPECT_FALSE(person.state().timing.since_start());
  go_to_page(person, "Plots");
}

void choose_the_map(Person& person) {
  go_to_page(person, "Map");
  const ui::MapChoice& choice = person.state().map.choice;
  person.click("map algorithms");
  person.click("map all");
  EXPECT_EQ(choice.algorithms.size(), algorithms().size());
  if (!person.sees("map under none")) person.click("map algorithms");
  person.click("map under none");
  EXPECT_EQ(choice.algorithms.size() + 1, algorithms().size());
  person.put_everything_away();
  person.click("map algorithms");
  person.click("map in force");
  EXPECT_TRUE(choice.algorithms.empty());
  for (const char* axis : {"0", "1"}) {
    const ui::MapAxisChoice& chosen = choice.axes.at(axis[0] == '0' ? 0 : 1);
    person.click(std::string("map number ") + axis);
    person.click(std::string("map choice ") + axis + " device.mass_kg");
    EXPECT_EQ(chosen.path, "device.mass_kg");
    person.type(std::string("map from ") + axis, "0.01");
    EXPECT_EQ(chosen.range->low, 0.01);
    person.type(std::string("map to ") + axis, "0.02");
    EXPECT_EQ(chosen.range->high, 0.02);
    person.click(std::string("map log ") + axis);
    EXPECT_FALSE(chosen.range->logarithmic);
    person.click(std::string("map around ") + axis);
    person.wait_a_frame();
    EXPECT_FALSE(chosen.typed);
  }
  person.state().map.choice = {};
  person.wait_a_frame();
}

void click_the_map(Person& person) {
  go_to_page(person, "Map");
  person.wait_until([&] { return person.state().map.live.up_to_date(); }, "the first picture");
  const Scene before = person.scene();
  person.click("map cells 0");
  EXPECT_NE(person.scene(), before);
  person.click("undo");
  EXPECT_EQ(person.scene(), before);
  go_to_page(person, "Plots");
}

// Ends the ranking, and uses the coarse accuracy, which comes within a second.
void compute_studies(Person& person) {
  go_to_page(person, "Study");
  ui::Studies& studies = person.state().studies;
  person.click("study compute");
  EXPECT_TRUE(studies.running());
  person.click("study compute");
  EXPECT_FALSE(studies.running());
  person.click("study accuracy");
  const ui::SceneStudy& accuracy = studies.shown();
  person.click("study compute");
  if (!person.wait_until([&] { return accuracy.result() != nullptr; }, "the coarse result")) return;
  person.click("study compute");
  EXPECT_FALSE(studies.running());
  person.click("study csv");
  EXPECT_EQ(person.clipboard(), accuracy.result()->csv);
  person.click("study copy");
  EXPECT_EQ(person.clipboard(), table::sheet_text(accuracy.result()->sheet));
  person.click("study column integrator");
  person.click("study worst-hand");
  EXPECT_NE(&studies.shown(), &accuracy);
  person.click("study hands");
  EXPECT_NE(&studies.shown(), &accuracy);
  person.click("study ranking");
  EXPECT_NE(&studies.shown(), &accuracy);
  go_to_page(person, "Plots");
}

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
  EXPECT_TRUE(std::filesystem::exists(person.state().recording.folder + "/mine.toml"))
      << person.message().text;
  person.put_everything_away();
  go_to_page(person, "Plots");
}

void click_all_at_once(Person& person) {
  go_to_page(person, "All at once");
  const ui::AllRuns& all = person.state().all_runs;
  const AlgorithmSettings before = person.scene().algorithm;
  const auto runs_are_there = [&] { return all.up_to_date(); };
  person.wait_until(runs_are_there, "the runs");
  const std::size_t count = all.runs().size();
  for (std::size_t i = 0; i < count; ++i) {
    // A form of an algorithm stays chosen in the runs of the others.
    person.wait_until(runs_are_there, "the runs");
    const ComparedAlgorithm algorithm = all.runs()[i].algorithm;
    person.click("all " + algorithm.label);
    EXPECT_EQ(person.scene().algorithm, algorithm.settings) << algorithm.label;
  }
  for (std::size_t i = 0; i < count && person.scene().algorithm != before; ++i) {
    person.click("undo");
  }
  EXPECT_EQ(person.scene().algorithm, before);
  go_to_page(person, "Plots");
}

Slot active(Person& person) { return ui::slots_of(person.state().compare).active; }

void use_slots(Person& person) {
  const auto in = [&](Slot slot) { return ui::slots_of(person.state().compare).of(slot); };
  person.click("slot B");
  EXPECT_EQ(active(person), Slot::kB);
  person.click("take A");
  EXPECT_EQ(in(Slot::kA), in(Slot::kB));
  person.click("undo");
  person.click("slot A");
  EXPECT_EQ(active(person), Slot::kA);
  person.click("take B");
  EXPECT_EQ(in(Slot::kB), in(Slot::kA));
  person.click("undo");
}

void touch(Person& person) {
  reset_once(person, [&] { person.click("reset"); });
  person.wait_until(
      [&] {
        const Sample sample = person.session().snapshot().newest.x();
        return (sample.flags & kFlagInContact) != 0 && sample.time_s > 1.0;
      },
      "a contact");
}

void see_a_ghost(Person& person) {
  touch(person);
  person.click("slot B");
  touch(person);
  person.wait_until([&] { return !person.items_called("ghost of").empty(); }, "a ghost");
  for (const std::string& legend : person.items_called("ghost of")) person.hover(legend);
  person.click("slot A");
}

void set_up_blind_test(Person& person) {
  go_to_page(person, "Blind test");
  person.type("blind question", "Which is steadier?");
  EXPECT_EQ(person.state().compare.persisted.question, "Which is steadier?");
  person.type("blind trials", "2");
  EXPECT_EQ(person.state().compare.persisted.trials, 2U);
  person.type("blind confidence", "90");
  EXPECT_NEAR(person.state().compare.persisted.confidence, 0.9, 1e-12);
  for (const bool masked : {false, true}) {
    person.click("masking noise");
    EXPECT_EQ(person.state().compare.persisted.masking_noise, masked);
  }
  person.click("blind list");
  const std::string folder = person.state().recording.folder;
  EXPECT_TRUE(
      std::filesystem::exists(folder + "/" + person.session().scene().name + "-blind-test.csv"));
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

void type_a_mark(Person& person) {
  const auto type = [&] { person.type("mark text", "here"); };  // Enter sets it
  set_marks(person, type);
  EXPECT_EQ(person.session().marks().back().text, "here");
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
    EXPECT_EQ(person.state().selection.axis, ui::Axis::kY);
    person.click(std::string(place) + " axis x");
    EXPECT_EQ(person.state().selection.axis, ui::Axis::kX);
  }
  open_scene(person, "layers");
  person.click("wall 3");
  EXPECT_EQ(person.state().selection.wall, 2U);
  person.click("wall 1");
  open_scene(person, "press");
}

}  // namespace

Table page_rows() {
  return {page("Timing", "timing clear"),     page("Blind test", "blind list"),
          page("Map", "map algorithms"),      page("All at once", "all none"),
          page("Study", "study compute"),     {"study compute", compute_studies},
          page("Identify", "identify start"), {"identify start", identify_the_device},
          page("Plots", "plot Force"),        {"timing clear", hover_timing},
          {"map algorithms", choose_the_map}, {"map cells 0", click_the_map},
          {"all none", click_all_at_once},    shown("penetration")};
}

Table compare_rows() {
  return {
      flips("section Compare",
            [](Person& p) { return p.state().compare.persisted.open ? 1.0 : 0.0; }),
      {"slot A", use_slots},
      flips("ghost", [](Person& p) { return p.state().compare.persisted.ghost_shown ? 1.0 : 0.0; }),
      {"page Plots", see_a_ghost},
      {"blind list", set_up_blind_test}};
}

Table experiment_rows() { return {{"go on", play_trial_list}}; }

Table recording_rows() {
  return {does("mark", [](Person& p, const Act& click) { set_marks(p, click); }),
          {"mark text", type_a_mark},
          {"time slider", use_replay}};
}

Table corner_rows() { return {{"wall axis y", use_corner}}; }

}  // namespace hapticwall::test
