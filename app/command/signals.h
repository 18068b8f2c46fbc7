// Signals, and the frame of a program around them.
#pragma once

#include <csignal>
#include <functional>
#include <string_view>

#include "app/session/loop/stop_signals.h"
#include "core/result.h"

namespace hapticwall::command {

// Runs a program and reports its error or exception; returns the exit status. A full disk and a
// closed pipe become errors of write() instead of signals.
[[nodiscard]] int run_guarded(const std::function<Result<int>()>& program);

using session::catch_stop_signals;
using session::stop_signal;

// The exit status that shells give a program that a signal ended.
[[nodiscard]] constexpr int status_of_signal(int signal) { return 128 + signal; }
// The exit status of a run whose only reader has left.
inline constexpr int kReaderLeft = status_of_signal(SIGPIPE);

// Prints "ended early by Ctrl-C" and `rest` on standard error; returns the exit status, 128 +
// signal.
[[nodiscard]] int ended_early(std::string_view rest = "; nothing was written");

// The exit status of a window that has closed: its error, or the signal that closed it.
[[nodiscard]] Result<int> status_after_window(const Failure& failed);

}  // namespace hapticwall::command
