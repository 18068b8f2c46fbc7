#include "device/link/stand_in.h"

#include <cmath>

namespace hapticwall::device::hid {
namespace {

constexpr std::int64_t kNanosecondsInMicrosecond = 1000;

}  // namespace

// The latch is the arrival: the device has no clock that is known here.
void StandIn::latch(std::int64_t now_ns) {
  time_us_ = std::max(now_ns / kNanosecondsInMicrosecond, time_us_ + min_step_us_);
  state_.time_us = static_cast<std::uint32_t>(time_us_);
  ++state_.sequence;
}

ReportBytes StandIn::state(const std::array<double, kMaxAxes>& position_m, std::int64_t now_ns,
                           const Told& told) {
  const std::lock_guard lock(mutex_);
  latch(now_ns);
  if (told.answer) {
    acknowledge(told.answer->sequence, told.answer->enabled, now_ns);
    state_.applied_force_n[0] = told.answer->force_n;
  }
  StateReport report = state_;
  for (std::size_t axis = 0; axis < kMaxAxes; ++axis) {
    if (encoder_m_[axis] <= 0.0) continue;
    if (std::isfinite(position_m[axis])) {
      state_.position_counts[axis] = saturated_count(position_m[axis] / encoder_m_[axis]);
    } else {
      report.status |= kStatusEncoderFault;
    }
    report.position_counts[axis] = state_.position_counts[axis];
  }
  if (told.fault) report.fault = kFirstOwnFault;
  if (told.calibrated) report.status |= kStatusCalibrated;
  return encode_state(report);
}

void StandIn::acknowledge(std::uint16_t sequence, bool enabled, std::int64_t now_ns) {
  state_.status = enabled ? kStatusEnabled : 0;
  if (sequence == state_.acknowledged_sequence) return;
  state_.acknowledged_sequence = sequence;
  state_.acknowledged_time_us =
      static_cast<std::uint32_t>(std::max(now_ns / kNanosecondsInMicrosecond, time_us_));
}

void StandIn::took(const ForceReport& command, std::int64_t now_ns) {
  const std::lock_guard lock(mutex_);
  acknowledge(command.sequence, command.enable, now_ns);
  state_.applied_force_n = command.enable ? command.force_n : std::array<double, kMaxAxes>{};
}

void StandIn::refused() {
  const std::lock_guard lock(mutex_);
  ++state_.rejected_commands;
}

}  // namespace hapticwall::device::hid
