// The sizes of a loop's queues, and the state that it publishes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "app/session/loop/arming.h"
#include "app/session/loop/latency_histogram.h"
#include "core/sample.h"
#include "device/link_stats.h"

namespace hapticwall::session {

// Capacities of the queues that carry every tick, in ticks.
struct QueueCapacities {
  std::size_t plot = 1U << 16U;
  std::size_t recorder = 1U << 17U;
  std::size_t sound = 1U << 11U;
};

// Since the start of the session. Wake latency and compute time cover every cycle, also those in a
// pause.
struct TimingStatistics {
  std::uint64_t ticks = 0;
  std::uint64_t missed_ticks = 0;
  std::uint64_t rested_periods = 0;  // left out while a simulator was paused
  double wake_latency_s = 0.0;       // latency of the newest tick
  double maximum_wake_latency_s = 0.0;
  double compute_time_s = 0.0;  // compute time of the newest tick
  double maximum_compute_time_s = 0.0;
  // Compute time over the last second with ticks, updated four times a second.
  std::uint32_t cost_ticks = 0;  // 0: not known yet
  double median_cost_s = 0.0;    // within 4 %
  double maximum_cost_s = 0.0;
};

// Every cycle since the start of the session, across resets and pauses.
struct TimingHistograms {
  LatencyCounts wake_latency;
  LatencyCounts compute_time;
};

// Clauses for people: for ArmingStatus::mostly_at_limit(), and for a weak force.
inline constexpr std::string_view kAtLimitText =
    "the force was at its limit for most of the armed time: a hand that is stronger than the "
    "limit, "
    "or a device that does not obey";
inline constexpr std::string_view kWeakText =
    "press into a wall for a second: the force is weak until the handle obeys";

// State of a real device's force: it acts, or why not.
struct ArmingStatus {
  ArmingState state = ArmingState::kNotNeeded;
  ArmingNote note = ArmingNote::kNone;
  double gain = 1.0;              // factor of the force, 0 to 1
  std::uint32_t asked = 0;        // answered requests to arm, granted or refused
  double since_s = 0.0;           // session's time at which `state` began
  double limit_share = 1.0;       // share of the force limit: below 1 until the handle has obeyed
  std::uint64_t armed_ticks = 0;  // since the start, and those of them with the full force
  std::uint64_t limit_ticks = 0;

  // True if at least one second was armed, and more than half of the armed time had the force at
  // its limit. `rate_hz`: tick rate.
  [[nodiscard]] bool mostly_at_limit(double rate_hz) const {
    return static_cast<double>(armed_ticks) >= rate_hz && 2 * limit_ticks > armed_ticks;
  }
};

// The newest tick and the state of the loop. Trivially copyable.
struct Snapshot {
  Tick newest;
  TimingStatistics timing;
  ArmingStatus arming;
  device::LinkStats link;              // statistics of a real device
  std::uint64_t cycles = 0;            // since the start of the session, also without a tick
  std::uint32_t generation = 0;        // generation of the parameters in force
  std::uint32_t resets = 0;            // how often the session went back to tick 0
  std::uint32_t periods_per_tick = 1;  // slow motion of a simulator
  bool paused = false;
  bool ended_by_fault = false;  // the loop gave up: force is zero, the device is closed
};

}  // namespace hapticwall::session
