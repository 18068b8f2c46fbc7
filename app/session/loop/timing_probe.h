// Measures timing with the real-time loop without a scene: records every wake-up, optionally on a
// real device whose force stays off.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "app/session/loop/clock.h"
#include "app/session/loop/realtime_setup.h"
#include "device/device.h"

namespace hapticwall::session {

struct TimingRecord {
  RealtimeStatus status;
  std::uint64_t missed_ticks = 0;
  double processor_share = 0.0;          // share of one core
  std::vector<std::int64_t> latency_ns;  // latency of every wake-up
  std::vector<std::int64_t> compute_ns;  // work of every tick: the device's read and write
  // Times of a device, for each tick with a new state.
  std::vector<std::int64_t> age_ns;
  std::vector<std::int64_t> round_trip_ns;
  std::vector<std::int64_t> write_ns;
  device::LinkStats link;  // statistics at the end
  std::string delay_date;  // see DeviceInfo::delay_date; the caller adds it
};

struct TimingPlan {
  double rate_hz = 1000.0;
  std::uint64_t ticks = 0;
  int affinity_core = -1;
  double spin_s = 0.0;  // see SessionOptions::spin_s
};

// Runs `ticks` cycles in a new thread, or until `should_stop` returns true on the caller's thread.
// `device`: open, or nullptr. Allocates the memory for all ticks first. Realtime-safe: no.
[[nodiscard]] TimingRecord probe_timing(const TimingPlan& plan, device::Device* device,
                                        Clock& clock,
                                        const std::function<bool(std::uint64_t done)>& should_stop);

}  // namespace hapticwall::session
