// How well this machine keeps time: the real-time loop without a scene, every wake-up written down,
// on nothing or on a real device whose force stays off.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "app/runtime/clock.h"
#include "app/runtime/quantiles.h"
#include "app/runtime/session.h"
#include "device/device.h"

namespace hapticwall::runtime {

struct TimingRecord {
  RealtimeStatus status;
  std::uint64_t missed_ticks = 0;
  double processor_share = 0.0;          // of one core, that the loop took
  std::vector<std::int64_t> latency_ns;  // of every wake-up
  std::vector<std::int64_t> compute_ns;  // of every tick's work: the device's read and write
  // Of a device, every tick in which there was something new.
  std::vector<std::int64_t> age_ns;
  std::vector<std::int64_t> round_trip_ns;
  std::vector<std::int64_t> write_ns;
  device::LinkFigures link;  // at the end
};

struct TimingPlan {
  double rate_hz = 1000.0;
  std::uint64_t ticks = 0;
  int affinity_core = -1;
  double spin_s = 0.0;  // as SessionOptions::spin_s
};

// Runs the loop in a thread of its own, `ticks` of them, fewer where `should_stop` says so (asked
// from the caller's thread; `done` ticks are told to it). `device`: open, or nullptr. Memory for
// every tick is taken before it begins. Realtime-safe: no.
[[nodiscard]] TimingRecord probe_timing(const TimingPlan& plan, device::Device* device,
                                        Clock& clock,
                                        const std::function<bool(std::uint64_t done)>& should_stop);

}  // namespace hapticwall::runtime
