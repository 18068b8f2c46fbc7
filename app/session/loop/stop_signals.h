// SIGINT and SIGTERM ask the program to end.
#pragma once

#include <array>
#include <csignal>
#include <cstddef>
#include <cstdint>

namespace hapticwall::session {

// A loop, or a call into a plug-in, that is silent for so long hangs: after a stop signal it ends
// the process.
inline constexpr std::int64_t kMaxSilenceNs = 1'000'000'000;

// Lets SIGINT and SIGTERM only ask the program to end; stop_signal() then returns the signal. A
// second one of the same kind ends the force of every loop, then the program, by the signal. The
// first one does the same as soon as something hangs (kMaxSilenceNs), before or after it. It uses
// SIGALRM. A signal that is ignored stays ignored. Realtime-safe: no.
void catch_stop_signals();

// The signal that asked the program to end; 0 if none has. Realtime-safe: yes.
[[nodiscard]] int stop_signal();

// catch_stop_signals() for its lifetime, for the window: no signal has come at its start, and the
// handlers of before come back at its end. The signal stays known.
class StopSignals {
 public:
  StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
  ~StopSignals();

 private:
  static constexpr std::array kSignals{SIGINT, SIGTERM};
  std::array<struct sigaction, kSignals.size()> before_{};
};

}  // namespace hapticwall::session
