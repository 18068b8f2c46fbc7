// A recording that somebody makes and opens in the window.
#pragma once

#include "tests/window/person.h"

namespace hapticwall::test {

// Records for a moment, with a mark, and opens that; and the way back.
void open_a_recording(Person& person);
void back_to_the_scene(Person& person);

}  // namespace hapticwall::test
