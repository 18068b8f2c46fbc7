// What stands beside the session's own controls: pages, Compare, blind test, marks, replay, corner.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>

#include "app/runtime/session/replay_session.h"
#include "app/ui/state/blind_test.h"
#include "app/ui/state/comparing.h"
#include "tests/window/recordings.h"
#include "tests/window/rows.h"

namespace hapticwall::test {
namespace {

using compare::Slot;

runtime::ReplaySession& replayed(Person& person) { return *person.replay(); }

Row page(const char* name, ui::LowerPage wanted) {
  return sets(
      std::string("page ") + name,
      [](Person& p) { return static_cast<double>(p.state().persisted.lower_page); },
      static_cast<double>(wanted));
}

void go_to_page(Person& person, const char* name) {
  person.click(std::string("page ") + name);
  person.wait_a_frame();
}

void hover_timing(Person& person) {
  go_to_page(person, "Timing");
  for (const char* item : {"median", "p99", "p99.9", "max", "ticks", "missed ticks",
                           "plot Wake-up latency", "plot Compute time"})
    person.hover(item);
  const std::uint64_t before = person.state().timing.shown.ticks;
  person.wait_until([&] { return person.state().timing.shown.ticks > before + 50; }, "ticks");
  person.click("timing clear");
  person.wait_a_frame();
  person.wait_a_frame();
  EXPECT_FALSE(person.state().timing.since_start());
  go_to_page(person, "Plots");
}

Slot active(Person& person) { return ui::slots_of(person.state()).active; }

void use_slots(Person& person) {
  person.click("slot B");
  EXPECT_EQ(active(person), Slot::kB);
  EXPECT_EQ(person.scene().algorithm, ui::slots_of(person.state()).of(Slot::kB));
  if (person.sees("take A")) person.click("take A");
  EXPECT_EQ(ui::slots_of(person.state()).of(Slot::kA), person.scene().algorithm);
  person.click("undo");
  person.click("slot A");
  EXPECT_EQ(active(person), Slot::kA);
  person.click("take B");
  EXPECT_EQ(ui::slots_of(person.state()).of(Slot::kB), person.scene().algorithm);
  person.click("undo");
}

void touch(Person& person) {
  const std::uint32_t resets = person.session().snapshot().resets;
  person.click("reset");
  person.wait_until([&] { return person.session().snapshot().resets > resets; }, "the reset");
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
  person.type("blind seed", "7");
  EXPECT_EQ(person.state().compare.transient.seed, 7U);
  person.click("blind start");
  EXPECT_TRUE(ui::blind_test_runs(person.state()));
}

void answer(Person& person, const char* choice) {
  person.hover("energy: hidden");
  person.hover("trial …");
  person.click("feel first");
  person.click("feel second");
  person.click(choice);
}

void take_blind_test(Person& person) {
  set_up_blind_test(person);
  answer(person, "choose first");
  answer(person, "choose second");
  EXPECT_FALSE(ui::blind_test_runs(person.state()));
  ASSERT_TRUE(person.state().compare.transient.test.has_value());
  EXPECT_EQ(person.state().compare.transient.test->trials.result().trials, 2U);
  for (const char* item : {"answered", "chose A", "share of A", "p-value", "chose the first",
                           "trial", "order", "chosen", "looks", "time"}) {
    person.hover(item);
  }
  person.click("blind save");
  EXPECT_TRUE(
      std::filesystem::exists(person.state().compare.transient.test->saved_as + "-result.csv"));
  person.put_everything_away();
  person.click("new blind test");
  person.click("last result");
  person.click("new blind test");
  person.click("blind start");
  person.click("stop and show");
  EXPECT_FALSE(ui::blind_test_runs(person.state()));
  go_to_page(person, "Plots");
}

void set_a_mark(Person& person) {
  person.click("record");
  person.wait_until([&] { return person.recording().rows > 100; }, "rows");
  person.put_everything_away();
  const std::size_t before = person.session().marks().size();
  person.type("mark text", "here");  // Enter sets it
  EXPECT_EQ(person.session().marks().back().text, "here");
  person.click("mark");
  EXPECT_EQ(person.session().marks().back().text, "");
  EXPECT_EQ(person.session().marks().size(), before + 2);
  person.click("record");
  person.put_everything_away();
}

void move_in_time(Person& person) {
  const double before_s = replayed(person).position_s();
  person.drag_from("time slider", ImVec2(0.1F, 0.5F), ImVec2(40.0F, 0.0F));
  EXPECT_NE(replayed(person).position_s(), before_s);
  person.type("speed", "0.5");
  EXPECT_EQ(replayed(person).speed(), 0.5);
  person.click("speeds");
  person.wait_a_frame();
  const std::vector<std::string> speeds = person.items_called("speed ");
  ASSERT_FALSE(speeds.empty());
  for (const std::string& speed : speeds) {
    if (!person.sees(speed)) person.click("speeds");
    person.click(speed);
  }
  for (const bool loops : {true, false}) {
    person.click("repeat");
    EXPECT_EQ(replayed(person).loops(), loops);
  }
}

void rerun_under_all(Person& person) {
  person.click("re-run");
  person.wait_a_frame();
  for (const std::string& choice : person.items_called("re-run ")) {
    if (choice == "re-run nothing") continue;
    if (!person.sees(choice)) person.click("re-run");
    person.click(choice);
    person.wait_until([&] { return replayed(person).overlay() != nullptr; }, "what is laid over");
    person.wait_a_frame();
    for (const std::string& legend : person.items_called("under ")) person.hover(legend);
  }
  person.click("re-run");
  person.click("re-run nothing");
  person.wait_a_frame();
  EXPECT_EQ(replayed(person).overlay(), nullptr);
}

void use_replay(Person& person) {
  open_a_recording(person);
  move_in_time(person);
  rerun_under_all(person);
  back_to_the_scene(person);
}

void open_scene(Person& person, const std::string& name) {
  person.click("scene");
  person.click("scene " + name);
  person.wait_until([&] { return person.scene().name == name; }, "the scene");
  person.wait_a_frame();
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

void open_a_recording(Person& person) {
  set_a_mark(person);
  const std::string path = person.recording().path;
  person.drop(std::array{path});
  person.wait_until([&] { return person.replay() != nullptr; }, "the recording");
  person.wait_a_frame();
}

void back_to_the_scene(Person& person) {
  person.click("back to the scene");
  person.wait_until([&] { return person.replay() == nullptr; }, "the scene");
  person.wait_a_frame();
  person.put_everything_away();
}

Table page_rows() {
  using enum ui::LowerPage;
  return {page("Timing", kTiming),
          page("Blind test", kBlindTest),
          page("Plots", kPlots),
          {"timing clear", hover_timing},
          shown("penetration")};
}

Table compare_rows() {
  return {
      {"slot A", use_slots},
      flips("ghost", [](Person& p) { return p.state().compare.persisted.ghost_shown ? 1.0 : 0.0; }),
      {"page Plots", see_a_ghost},
      {"blind start", take_blind_test}};
}

Table recording_rows() { return {{"mark", set_a_mark}, {"time slider", use_replay}}; }

Table corner_rows() { return {{"wall axis y", use_corner}}; }

}  // namespace hapticwall::test
