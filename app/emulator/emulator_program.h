// The program hapticwall-emulator: its command line, and what follows from it.
#pragma once

namespace hapticwall::emulator {

// Returns the exit status, which means what those of hapticwall mean.
int run_program(int argc, const char* const* argv);

}  // namespace hapticwall::emulator
