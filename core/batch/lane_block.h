// The data of a batch's lanes: one number per lane of everything that a tick reads and writes. Each
// lane is one scene, independent of the others.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/stabiliser/stabiliser.h"

namespace hapticwall::batch {

// Of a group, on any processor.
inline constexpr std::size_t kMaxLanes = 32;
inline constexpr std::size_t kLaneAlignment = 64;  // of the widest vector, bytes

// One number per lane.
struct alignas(kLaneAlignment) LaneNumbers {
  std::array<double, kMaxLanes> lane{};

  [[nodiscard]] double& operator[](std::size_t i) { return lane[i]; }
  [[nodiscard]] double operator[](std::size_t i) const { return lane[i]; }
};

// A law's parameters or state.
using LaneLawNumbers = std::array<LaneNumbers, kMaxLawNumbers>;

// The scene's values as the tick needs them. All zero: a handle that never moves.
struct LaneParameters {
  // Servo.
  LaneNumbers rate_hz, encoder_m, force_limit_n, budget_n_per_m;
  LaneNumbers wall_m, wall_stiffness_n_per_m, wall_damping_n_s_per_m;
  LaneLawNumbers law;
  // Plant: OneBody's parameters and the rows of its whole tick.
  LaneNumbers damping_n_s_per_m, hand_stiffness_n_per_m, hand_damping_n_s_per_m, half_mass_kg;
  LaneNumbers duration_s;
  std::array<LaneNumbers, 2> velocity, drift, hand_force_drift, integral_at_rest;
  std::array<LaneNumbers, 3> square, hand_work, square_at_rest;
  // The present straight piece of the hand's path.
  LaneNumbers path_m, path_speed_m_per_s, segment_begin_tick, segment_m, period_s;
};

// State of the motion.
struct LaneMotion {
  LaneNumbers position_m, velocity_m_per_s;
  LaneNumbers measured_m, force_n;  // of the last tick
  LaneLawNumbers law;
  LaneNumbers saturated_ticks;
};

// Sums and extremes for the summary. N: LaneNumbers, or a vector of some lanes.
template <class N>
struct LaneSums {
  N measured_m, force_n;  // of the last accounted tick
  N maximum_m;            // begin_tail() starts it anew
  N contacts, peak_force_n;
  N cv_j, hold_j, scv_j, budget_j, min_cv_j, min_scv_j;
  N actuator_work_j, viscous_j, hand_work_j, margin_j;
};
// In the last second only.
template <class N>
struct LaneTail {
  N minimum_m, ticks, mean_n, square_n2, contact_force_n, contact_penetration_m;
};
struct LaneAccount {
  LaneSums<LaneNumbers> sums;
  LaneTail<LaneNumbers> tail;
  LaneNumbers in_contact;             // 1 or 0, at the last accounted tick
  LaneNumbers maximum_before_tail_m;  // before the last second
};

struct LaneState {
  LaneMotion motion;
  LaneAccount account;
};

// The motion of the last ticks, until they are accounted.
inline constexpr std::size_t kTraceTicks = 16;
struct LaneTrace {
  std::array<LaneNumbers, kTraceTicks> position_m, measured_m, force_n;
  std::array<LaneNumbers, kTraceTicks> net_force_n, displacement_m;  // of the plant, in the tick
  std::array<LaneNumbers, kTraceTicks + 1> velocity_m_per_s;         // and after the last tick
};

struct LaneBlock {
  LaneParameters parameters;
  LaneState state;
  LaneTrace trace;
};

// The parts that a stretch of ticks needs; its loop holds no others.
struct LaneParts {
  std::size_t algorithm = 0;  // index in algorithms(), of all lanes
  bool encoder = false;
  bool damped = false;  // a wall has a damper
  bool moving = false;  // some hand's path moves
  bool tail = false;    // some lane is in its last second
};

// Moves all lanes through ticks [begin, end), at most kTraceTicks, and fills the trace. Returns the
// tick that was reached.
using MoveLoop = std::uint64_t (*)(LaneBlock& block, std::uint64_t begin, std::uint64_t end);

// Lanes of a group on this processor, at most kMaxLanes.
[[nodiscard]] std::size_t lane_count();

// Ticks [begin, end) of all lanes. Every lane's path is straight, and its last second does not
// begin within. Returns `end`, or the first tick at which some lane is outside ±1 m; that tick has
// not passed in any lane. Realtime-safe: yes.
[[nodiscard]] std::uint64_t run_lanes(LaneBlock& block, const LaneParts& parts, std::uint64_t begin,
                                      std::uint64_t end);

}  // namespace hapticwall::batch
