// Deeds that a button and a key do alike. Each function lets `act` press one of them, and checks
// the effect.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "tests/window/person.h"

namespace hapticwall::test {

using Act = std::function<void()>;
// A value of the window, or of its session.
using Look = std::function<double(Person&)>;

// One `act` changes the value, a second one changes it back.
void flip_twice(Person& person, const Look& look, const Act& act);

void pause_and_run(Person& person, const Act& act);
void step_once(Person& person, const Act& act);
void reset_once(Person& person, const Act& act);
void record_and_stop(Person& person, const Act& act);
// Records until `act` has set this many marks.
void set_marks(Person& person, const Act& act, std::size_t count = 1);
void undo_once(Person& person, const Act& act);
void redo_once(Person& person, const Act& act);

void open_scene(Person& person, const std::string& name);
// Records for a moment with two marks, and opens the recording.
void open_a_recording(Person& person);
void back_to_the_scene(Person& person);

}  // namespace hapticwall::test
