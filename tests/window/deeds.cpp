#include "tests/window/deeds.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>

namespace hapticwall::test {
namespace {

void wait_until_paused(Person& person, bool paused) {
  person.wait_until([&] { return person.session().snapshot().paused == paused; }, "pause");
}

void set_algorithm(Person& person, std::size_t index) {
  AlgorithmSettings settings = person.scene().algorithm;
  settings.index = index;
  EXPECT_FALSE(person.live().set_algorithm(settings));
  person.wait_a_frame();
}

}  // namespace

void flip_twice(Person& person, const Look& look, const Act& act) {
  const double before = look(person);
  act();
  EXPECT_NE(look(person), before);
  act();
  EXPECT_EQ(look(person), before);
}

void pause_and_run(Person& person, const Act& act) {
  for (const bool paused : {true, false}) {
    act();
    wait_until_paused(person, paused);
  }
}

void step_once(Person& person, const Act& act) {
  const auto tick = [&] { return person.session().snapshot().newest.x().tick; };
  person.session().pause(true);
  wait_until_paused(person, true);
  person.wait_a_frame();
  const std::uint64_t before = tick();
  act();
  person.wait_until([&] { return tick() > before; }, "a tick");
  EXPECT_EQ(tick(), before + 1);
  person.session().pause(false);
  wait_until_paused(person, false);
}

void reset_once(Person& person, const Act& act) {
  const std::uint32_t before = person.session().snapshot().resets;
  act();
  person.wait_until([&] { return person.session().snapshot().resets == before + 1; }, "the reset");
}

void record_and_stop(Person& person, const Act& act) {
  act();
  EXPECT_EQ(person.recording().state, session::RecordingState::kRecording);
  person.wait_until([&] { return person.recording().rows > 0; }, "rows");
  person.put_everything_away();
  act();
  EXPECT_EQ(person.recording().state, session::RecordingState::kIdle);
  const std::filesystem::path path = person.recording().path;
  EXPECT_TRUE(std::filesystem::exists(path));
  EXPECT_EQ(path.parent_path(), person.state().recording.folder);
}

void set_marks(Person& person, const Act& act, std::size_t count) {
  person.click("record");
  person.wait_until([&] { return person.recording().rows > 100; }, "rows");
  person.put_everything_away();
  const std::size_t before = person.session().marks().size();
  act();
  EXPECT_EQ(person.session().marks().size(), before + count);
  person.click("record");
  person.put_everything_away();
}

void undo_once(Person& person, const Act& act) {
  set_algorithm(person, 0);
  set_algorithm(person, 1);
  EXPECT_TRUE(person.has_tooltip("undo"));
  act();
  EXPECT_EQ(person.scene().algorithm.index, 0U);
}

void redo_once(Person& person, const Act& act) {
  undo_once(person, [&] { person.click("undo"); });
  EXPECT_TRUE(person.has_tooltip("redo"));
  act();
  EXPECT_EQ(person.scene().algorithm.index, 1U);
}

void open_scene(Person& person, const std::string& name) {
  person.click("scene");
  person.click("scene " + name);
  person.wait_until([&] { return person.scene().name == name; }, "the scene");
  person.wait_a_frame();
}

void open_a_recording(Person& person) {
  const auto mark_twice = [&] {
    person.click("mark");
    person.wait_for_ticks(1);
    person.click("mark");
  };
  set_marks(person, mark_twice, 2);
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

}  // namespace hapticwall::test
