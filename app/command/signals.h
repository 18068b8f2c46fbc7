// Ctrl-C and its kin.
#pragma once

#include <string_view>

namespace hapticwall::command {

// A full disk and a reader that left are errors of write(), not signals. Call it first of all.
void ignore_write_signals();

// From now on SIGINT and SIGTERM only ask the program to end; a second one of the same ends it at
// once, after the force of every loop.
void catch_stop_signals();

// The signal that asked the program to end; 0 while none has. Realtime-safe: yes.
[[nodiscard]] int stop_signal();

// Exit status of a program that a signal ended early, as shells have it.
[[nodiscard]] constexpr int signal_exit_status(int signal) { return 128 + signal; }

[[nodiscard]] std::string_view signal_name(int signal);

}  // namespace hapticwall::command
