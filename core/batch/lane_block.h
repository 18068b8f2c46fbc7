// What the lanes of a batch share with the code that feeds them: one number per lane of everything
// that a tick reads and writes. A lane is a scene of its own; lanes know nothing of each other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace hapticwall::batch {

// No group of lanes is wider, whatever the processor.
inline constexpr std::size_t kMostLanes = 32;
inline constexpr std::size_t kLaneAlignment = 64;  // of the widest vector, bytes

// One number per lane.
struct alignas(kLaneAlignment) LaneNumbers {
  std::array<double, kMostLanes> lane{};

  [[nodiscard]] double& operator[](std::size_t i) { return lane[i]; }
  [[nodiscard]] double operator[](std::size_t i) const { return lane[i]; }
};

// The algorithms that have lanes (lane_laws-inl.h).
enum class LaneLaw : std::uint8_t {
  kNone,
  kVirtualCoupling,
  kPassivityControl,
  kEnergyBounding,
  kEnergyBounding2010,
  kForceBounding,
  kHalfSample,
  kEnergyBookkeeping
};
inline constexpr std::size_t kLawParameters = 6;
inline constexpr std::size_t kLawStates = 3;

// What a scene names, as the tick needs it. All zero: a handle that never moves.
struct LaneParameters {
  // Servo.
  LaneNumbers rate_hz, encoder_m, force_limit_n, budget_n_per_m;
  LaneNumbers wall_m, wall_stiffness_n_per_m, wall_damping_n_s_per_m;
  std::array<LaneNumbers, kLawParameters> law;
  // Plant: OneBody's parameters and the rows of its whole tick.
  LaneNumbers damping_n_s_per_m, hand_stiffness_n_per_m, hand_damping_n_s_per_m, half_mass_kg;
  LaneNumbers duration_s;
  std::array<LaneNumbers, 2> velocity, drift, hand_force_drift, integral_at_rest;
  std::array<LaneNumbers, 3> square, hand_work, square_at_rest;
  // The straight piece that the hand's path is on.
  LaneNumbers path_m, path_speed_m_per_s, segment_begin_tick, segment_m, period_s;
};

// What the motion itself needs from tick to tick.
struct LaneMotion {
  LaneNumbers position_m, velocity_m_per_s;
  LaneNumbers measured_m, force_n;  // of the last tick
  std::array<LaneNumbers, kLawStates> law;
  LaneNumbers saturated_ticks;
};

// Where the handle was: all that a verdict needs. begin_tail() puts the maximum of the time before
// the last second aside and starts anew.
struct LaneReach {
  LaneNumbers maximum_m;
  LaneNumbers minimum_m;  // followed in the last second only
  LaneNumbers maximum_before_tail_m;
};

// What only a whole summary needs.
struct LaneAccount {
  LaneNumbers measured_m, force_n;  // of the last tick that is accounted for
  LaneNumbers in_contact, contacts, peak_force_n;
  LaneNumbers cv_j, hold_j, scv_j, budget_j, min_cv_j, min_scv_j;
  LaneNumbers actuator_work_j, viscous_j, hand_work_j, margin_j;
  LaneNumbers tail_ticks, tail_mean_n, tail_square_n2;
  LaneNumbers tail_contact_force_n, tail_contact_penetration_m;
};

struct LaneState {
  LaneMotion motion;
  LaneReach reach;
  LaneAccount account;
};

// The last ticks' motion, kept until it is accounted for.
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

// What a stretch of ticks needs of the tick: what is not needed is not in its loop.
struct LaneParts {
  LaneLaw law = LaneLaw::kNone;
  bool encoder = false;
  bool damped = false;   // a wall has a damper
  bool account = false;  // the whole summary, not the verdict alone
  bool moving = false;   // some hand's path moves
  bool tail = false;     // some lane is in its last second
};

// Lanes of a group on this processor, at most kMostLanes.
[[nodiscard]] std::size_t lane_count();

// Ticks [begin, end) of all lanes; every lane's path is straight and its last second has either
// begun or not. Returns `end`, or the tick before which some lane has left ±1 m: nothing of that
// tick has happened yet, in any lane. Realtime-safe: yes.
[[nodiscard]] std::uint64_t run_lanes(LaneBlock& block, const LaneParts& parts, std::uint64_t begin,
                                      std::uint64_t end);

}  // namespace hapticwall::batch
