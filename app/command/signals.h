// Signals, and the frame of a program around them.
#pragma once

#include <functional>
#include <string_view>

#include "core/result.h"

namespace hapticwall::command {

// Runs a program and reports its error or exception; returns the exit status. A full disk and a
// closed pipe become errors of write() instead of signals.
[[nodiscard]] int run_guarded(const std::function<Result<int>()>& program);

// From now on SIGINT and SIGTERM only ask the program to end. A second one of the same kind ends
// the force of every loop, then the program.
void catch_stop_signals();

// The signal that asked the program to end; 0 if none has. Realtime-safe: yes.
[[nodiscard]] int stop_signal();

// Says "ended early by Ctrl-C" and `rest` on standard error; returns the exit status, 128 + signal.
[[nodiscard]] int ended_early(std::string_view rest = "; nothing was written");

}  // namespace hapticwall::command
