// The whole command line.
#pragma once

namespace hapticwall::command {

// Parses, dispatches, and returns the exit status. No exception leaves it.
[[nodiscard]] int run_program(int argc, const char* const* argv);

}  // namespace hapticwall::command
