// The program hapticwall-emulator.
#pragma once

namespace hapticwall::emulator {

// Returns the exit status, as `hapticwall` does.
int run_program(int argc, const char* const* argv);

}  // namespace hapticwall::emulator
