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
  double force_limit_n = std::numeric_limits<double>::infinity();
  double maximum_age_s = kDefaultMaximumAgeS;
  double transition_s = kSwitchTransitionS;
  WallSet walls;
  AlgorithmSettings algorithm;

  [[nodiscard]] double period_s() const { return 1.0 / rate_hz; }
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
  double period_s = 1e-3;
  double believed_damping_n_s_per_m = 0.0;  // for the ledger's budget
  EnergyLedger ledger;
  SwitchTransition transition;
  bool parameters_changed = false;
  bool failed = false;  // a force that was not finite; sticky until reset
};

namespace detail {

struct LimitedForce {
  double force_n = 0.0;
  std::uint32_t flags = 0;
};

// Finite check, then clamp. Realtime-safe: yes.
[[nodiscard]] inline LimitedForce limit_force(double wanted_n, double limit_n, bool usable,
                                              ServoState& state) {
  if (!std::isfinite(wanted_n)) state.failed = true;
  if (state.failed || !usable) return {0.0, 0};
  const double force_n = std::clamp(wanted_n, -limit_n, limit_n);
  return {force_n, force_n == wanted_n ? 0U : static_cast<std::uint32_t>(kFlagForceLimit)};
}

}  // namespace detail

// One tick. `device` has `DeviceReading read()` and `void write(double)`; its `truth()`, where it
// has one, is copied into the sample before the write. Realtime-safe: yes, if the device is.
template <typename Device, typename Stabiliser>
inline void servo_step(const ServoSettings& settings, ServoState& state, Stabiliser& stabiliser,
                       Device& device, Sample& sample) {
  const DeviceReading reading = device.read();
  const bool stale = !(reading.age_s <= settings.maximum_age_s);
  const bool fault = reading.state != DeviceState::kOk || !std::isfinite(reading.position_m);
  const double position_m = fault ? state.previous_position_m : reading.position_m;

  const double displacement_m = state.tick == 0 ? 0.0 : position_m - state.previous_position_m;
  const double velocity_m_per_s = displacement_m * settings.rate_hz;
  const WallContact contact = evaluate_walls(settings.walls, position_m, velocity_m_per_s);

  const StabiliserInput input{contact.force_n,       position_m,
                              displacement_m,        velocity_m_per_s,
                              contact.penetration_m, state.previous_force_n,
                              contact.in_contact};
  double wanted_n = stabiliser.step(input);
  std::uint32_t flags =
      wanted_n == contact.force_n ? 0U : static_cast<std::uint32_t>(kFlagIntervened);
  if (state.transition.ticks_left > 0) {
    wanted_n = state.transition.blend(wanted_n, state.previous_force_n);
  }
  const detail::LimitedForce limited =
      detail::limit_force(wanted_n, settings.force_limit_n, !stale && !fault, state);

  if constexpr (requires { device.truth(); }) {
    if (const PlantTruth* truth = device.truth()) sample.truth = *truth;
  }
  device.write(limited.force_n);

  state.ledger.add(limited.force_n, state.previous_force_n, displacement_m, velocity_m_per_s,
                   state.believed_damping_n_s_per_m);

  flags |= limited.flags;
  if (contact.in_contact) flags |= kFlagInContact;
  if (stale) flags |= kFlagStaleInput;
  if (fault) flags |= kFlagDeviceFault;
  if (state.parameters_changed) flags |= kFlagParametersChanged;

  sample.tick = state.tick;
  sample.time_s = static_cast<double>(state.tick) / settings.rate_hz;
  sample.position_m = position_m;
  sample.velocity_m_per_s = velocity_m_per_s;
  sample.penetration_m = contact.penetration_m;
  sample.wall_force_n = contact.force_n;
  sample.force_n = limited.force_n;
  sample.stiffness_n_per_m = contact.in_contact ? limited.force_n / contact.penetration_m : 0.0;
  sample.energy_cv_j = state.ledger.cv_j;
  sample.energy_hold_j = state.ledger.hold_j;
  sample.energy_scv_j = state.ledger.scv_j;
  sample.energy_budget_j = state.ledger.budget_j;
  sample.flags = flags;

  state.previous_position_m = position_m;
  state.previous_force_n = limited.force_n;
  state.parameters_changed = false;
  ++state.tick;
}

}  // namespace hapticwall
