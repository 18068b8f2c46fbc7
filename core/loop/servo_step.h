// The fixed order of a tick, in one function:
//
//   read → age check → velocity → walls → stabiliser → finite check → magnitude clamp → write →
//   ledger → sample
//
// Finite before clamp: std::clamp(NaN, …) is NaN. Any failure means zero force. The live loop, the
// headless run and the tests all call this; only the device differs.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/device_reading.h"
#include "core/energy_ledger.h"
#include "core/sample.h"
#include "core/scene.h"
#include "core/stabiliser/stabiliser_list.h"
#include "core/wall.h"

namespace hapticwall {

// A position older than this is not acted upon.
inline constexpr double kDefaultMaximumAgeS = 0.02;
// A switch of algorithm while running blends the force over this long.
inline constexpr double kSwitchTransitionS = 0.05;

// What the loop needs of a scene. Trivially copyable.
struct ServoSettings {
  double rate_hz = 1000.0;
  double device_damping_n_s_per_m = 0.0;
  double encoder_m = 0.0;  // 0: none
  double force_limit_n =
      std::numeric_limits<double>::max();  // finite, so that an infinite force is over it
  double maximum_age_s = kDefaultMaximumAgeS;
  double transition_s = kSwitchTransitionS;
  WallSet walls;
  AlgorithmSettings algorithm;

  [[nodiscard]] double period_s() const { return 1.0 / rate_hz; }
  friend bool operator==(const ServoSettings&, const ServoSettings&) = default;
};

[[nodiscard]] ServoSettings servo_settings(const Scene& scene);
// Points into `settings`; valid as long as it is. Realtime-safe: yes.
[[nodiscard]] StabiliserContext stabiliser_context(const ServoSettings& settings);

// After a switch the force starts where it was: the difference to what the new algorithm asks for
// is kept as an offset that falls linearly to nothing.
struct SwitchTransition {
  std::uint32_t ticks_left = 0;
  std::uint32_t ticks_total = 0;
  double offset_n = 0.0;
  bool offset_known = false;

  // Realtime-safe: yes.
  [[nodiscard]] double blend(double force_n, double previous_force_n) {
    if (!offset_known) {
      offset_n = previous_force_n - force_n;
      offset_known = true;
    }
    const double weight = static_cast<double>(ticks_left) / static_cast<double>(ticks_total);
    --ticks_left;
    return force_n + weight * offset_n;
  }
};

struct ServoState {
  std::uint64_t tick = 0;
  double previous_position_m = 0.0;
  double previous_force_n = 0.0;
  double budget_n_per_m = 0.0;  // b/T, b as the algorithm believes it
  EnergyLedger ledger;
  SwitchTransition transition;
  // What reaches the device of the force, 0 to 1: less than 1 while a device is not or not yet
  // fully armed.
  double force_gain = 1.0;
  double previous_gain = 1.0;   // of the previous force
  bool position_known = false;  // the last reading was without fault
  bool parameters_changed = false;
  bool failed = false;  // a force that was not finite; sticky until reset
};

// What happened in a tick. The ledger after it stands in ServoState.
struct TickOutcome {
  std::uint64_t tick = 0;
  double position_m = 0.0;
  double age_s = 0.0;          // of the position
  double device_time_s = 0.0;  // of the position, by the device's clock
  double displacement_m = 0.0;
  double velocity_m_per_s = 0.0;
  WallContact contact;
  double force_n = 0.0;  // as commanded
  bool intervened = false;
  bool saturated = false;
  bool stale = false;
  bool fault = false;
  bool parameters_changed = false;
};

namespace detail {

// Finite check, then clamp; zero where the input was not to be trusted. Realtime-safe: yes.
[[nodiscard]] inline double restrict_force(double wanted_n, double limit_n, bool usable,
                                           ServoState& state) {
  if (!std::isfinite(wanted_n)) state.failed = true;
  if (state.failed || !usable) return 0.0;
  return std::clamp(wanted_n, -limit_n, limit_n);
}

// What is to be blended: what a stiff wall asks for beyond the limit would stay in the offset, and
// pull a handle in that leaves. What is not finite stays so. Realtime-safe: yes.
[[nodiscard]] inline double within(double wanted_n, double limit_n) {
  return std::isfinite(wanted_n) ? std::clamp(wanted_n, -limit_n, limit_n) : wanted_n;
}

// What the previous force would have been with all of it reaching the device. Realtime-safe: yes.
[[nodiscard]] inline double previous_full_force(const ServoState& state, double limit_n) {
  if (state.previous_gain == 1.0) return state.previous_force_n;
  if (state.previous_gain == 0.0) return 0.0;
  return std::clamp(state.previous_force_n / state.previous_gain, -limit_n, limit_n);
}

// No negative zero, and what is not finite stays so. Realtime-safe: yes.
[[nodiscard]] inline double scale_force(double wanted_n, double gain) {
  return gain == 0.0 && std::isfinite(wanted_n) ? 0.0 : wanted_n * gain;
}

}  // namespace detail

// What a caller knows of its ticks beforehand; a question that has one answer only is then not in
// the loop. Every such tick gives the same bits as one of which nothing is known.
struct StepKnowledge {
  bool sound_device = false;  // no reading is ever old or faulty
  // The last reading was sound, no switch is being blended, all of the force reaches the device,
  // and none was ever other than finite; see is_steady(). Stays true from tick to tick while
  // state.failed is false and the device is sound.
  bool steady = false;
  bool one_undamped_wall = false;
};

// Realtime-safe: yes, these two.
[[nodiscard]] inline bool is_steady(const ServoState& state) {
  return state.position_known && state.transition.ticks_left == 0 && state.force_gain == 1.0 &&
         state.previous_gain == 1.0 && !state.failed && !state.parameters_changed;
}
[[nodiscard]] inline bool has_one_undamped_wall(const ServoSettings& settings) {
  const auto walls = settings.walls.walls();
  return walls.size() == 1 && walls.front().damping_n_s_per_m == 0.0;
}

// One tick. `device` has `DeviceReading read()` and `void write(double)`. Realtime-safe: yes, if
// the device is.
template <StepKnowledge kKnown = StepKnowledge{}, typename Device, typename Stabiliser>
[[gnu::always_inline]] inline TickOutcome servo_step(const ServoSettings& settings,
                                                     ServoState& state, Stabiliser& stabiliser,
                                                     Device& device) {
  TickOutcome out;
  const DeviceReading reading = device.read();
  out.tick = state.tick;
  if constexpr (!kKnown.sound_device) {
    out.stale = !(reading.age_s <= settings.maximum_age_s);
    out.fault = reading.state != DeviceState::kOk || !std::isfinite(reading.position_m);
    out.age_s = reading.age_s;
    out.device_time_s = reading.device_time_s;
  }
  out.position_m = out.fault ? state.previous_position_m : reading.position_m;

  const bool known = kKnown.steady || state.position_known;
  out.displacement_m = known ? out.position_m - state.previous_position_m : 0.0;
  out.velocity_m_per_s = out.displacement_m * settings.rate_hz;
  out.contact = kKnown.one_undamped_wall
                    ? evaluate_undamped_wall(settings.walls.walls().front(), out.position_m)
                    : evaluate_walls(settings.walls, out.position_m, out.velocity_m_per_s);

  const StabiliserInput input{out.contact.force_n,       out.position_m,
                              out.displacement_m,        out.velocity_m_per_s,
                              out.contact.penetration_m, state.previous_force_n,
                              out.contact.in_contact};
  double wanted_n = stabiliser.step(input);
  out.intervened = wanted_n != out.contact.force_n;
  double limit_n = settings.force_limit_n;
  if constexpr (!kKnown.steady) {
    if (state.transition.ticks_left > 0) [[unlikely]] {
      out.saturated = std::abs(wanted_n) > limit_n;
      wanted_n = state.transition.blend(detail::within(wanted_n, limit_n),
                                        detail::previous_full_force(state, limit_n));
    }
    if (state.force_gain < 1.0) [[unlikely]] {
      wanted_n = detail::scale_force(wanted_n, state.force_gain);
      limit_n *= state.force_gain;  // a stiff wall is at its limit at once: that rises as well
    }
  }
  out.force_n = wanted_n;
  if (out.stale || out.fault || (!kKnown.steady && state.failed) ||
      !(std::abs(wanted_n) <= limit_n)) [[unlikely]] {
    out.saturated = out.saturated || std::abs(wanted_n) > limit_n;
    out.force_n = detail::restrict_force(wanted_n, limit_n, !out.stale && !out.fault, state);
  }
  device.write(out.force_n);

  state.ledger.add(out.force_n, state.previous_force_n, out.displacement_m, state.budget_n_per_m);
  state.previous_position_m = out.position_m;
  state.previous_force_n = out.force_n;
  if constexpr (!kKnown.steady) {
    state.previous_gain = state.force_gain;
    // Where the handle was meanwhile is not known: the first reading after a fault is no move.
    state.position_known = !out.fault;
    out.parameters_changed = state.parameters_changed;
    state.parameters_changed = false;
  }
  ++state.tick;
  return out;
}

// The tick as it is plotted and recorded; truth and generation are the caller's. Realtime-safe:
// yes.
inline void write_sample(const ServoSettings& settings, const EnergyLedger& ledger,
                         const TickOutcome& out, Sample& sample) {
  sample.tick = out.tick;
  sample.time_s = static_cast<double>(out.tick) / settings.rate_hz;
  sample.position_m = out.position_m;
  sample.velocity_m_per_s = out.velocity_m_per_s;
  sample.penetration_m = out.contact.penetration_m;
  sample.wall_force_n = out.contact.force_n;
  sample.force_n = out.force_n;
  // A penetration may be the smallest number there is; what is recorded is finite.
  constexpr double kMost = std::numeric_limits<double>::max();
  sample.stiffness_n_per_m =
      out.contact.in_contact ? std::clamp(out.force_n / out.contact.penetration_m, -kMost, kMost)
                             : 0.0;
  sample.energy_cv_j = ledger.cv_j;
  sample.energy_hold_j = ledger.hold_j;
  sample.energy_scv_j = ledger.scv_j;
  sample.energy_budget_j = ledger.budget_j;
  sample.device_time_s = out.device_time_s;
  sample.read_age_s = out.age_s;
  const auto flag = [](bool set, SampleFlag bit) {
    return set ? static_cast<std::uint32_t>(bit) : 0U;
  };
  sample.flags = flag(out.contact.in_contact, kFlagInContact) |
                 flag(out.saturated, kFlagForceLimit) | flag(out.intervened, kFlagIntervened) |
                 flag(out.stale, kFlagStaleInput) | flag(out.fault, kFlagDeviceFault) |
                 flag(out.parameters_changed, kFlagParametersChanged);
}

}  // namespace hapticwall
