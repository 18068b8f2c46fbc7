// Speaks docs/hid-protocol.md in the place of a device that does not: makes STATE reports of its
// positions, and acknowledges the commands that it took. Link, threads and judge are then those of
// any device. Two threads; no I/O and no clock.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <mutex>
#include <optional>

#include "device/link/report.h"

namespace hapticwall::device::hid {

// Facts that a device reports beside its position.
struct Told {
  bool fault = false;       // a fault of the device itself
  bool calibrated = false;  // position 0 is a fixed place
  // The command that it obeys, whether it gives a force, and which, newtons towards growing counts.
  // nullopt: it tells nothing, and the command that was taken last counts.
  struct Answer {
    std::uint16_t sequence = 0;
    bool enabled = false;
    double force_n = 0.0;
  };
  std::optional<Answer> answer{};
};

class StandIn {
 public:
  // Metres a count, positive for each axis of the device. `min_step_ns`: of the clock between two
  // states; reports that waited in a queue arrive together.
  StandIn(const std::array<double, kMaxAxes>& encoder_m, std::int64_t min_step_ns)
      : encoder_m_(encoder_m), min_step_us_(std::max<std::int64_t>(min_step_ns / 1000, 1)) {}

  // Reader: a new state. A position that is not finite is a fault of the encoder.
  [[nodiscard]] ReportBytes state(const std::array<double, kMaxAxes>& position_m,
                                  std::int64_t now_ns, const Told& told = {});
  // Writer: the device took this command, and tells no answer.
  void took(const ForceReport& command, std::int64_t now_ns);
  // Writer: the device took no command; the next state counts it as rejected.
  void refused();

 private:
  void latch(std::int64_t now_ns);
  void acknowledge(std::uint16_t sequence, bool enabled, std::int64_t now_ns);

  const std::array<double, kMaxAxes> encoder_m_;
  const std::int64_t min_step_us_;
  std::mutex mutex_;
  StateReport state_;         // these under the mutex
  std::int64_t time_us_ = 0;  // of the state
};

}  // namespace hapticwall::device::hid
