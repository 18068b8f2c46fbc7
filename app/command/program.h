// The whole command line.
#pragma once

#include "app/session/window_options.h"

namespace hapticwall::command {

// Parses, dispatches, and returns the exit status. Throws nothing. `open` opens the window.
[[nodiscard]] int run_program(int argc, const char* const* argv, const session::OpenWindow& open);

}  // namespace hapticwall::command
