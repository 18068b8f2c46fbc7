// The fixed order of a tick, in one function:
//
//   read → age check → velocity (estimator) → environment → algorithm → finite check →
//   magnitude clamp → write → ledger → sample
//
// Finite before clamp, because std::clamp(NaN, …) is NaN. Any failure means zero force. The live
// loop, the headless run and the tests call the same function with different devices.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/algorithm/followed_algorithm.h"
#include "core/environment/active_environment.h"
#include "core/environment/walls.h"
#include "core/estimator/active_estimator.h"
#include "core/sample.h"
#include "core/tick/device_reading.h"
#include "core/tick/servo_settings.h"
#include "core/tick/servo_state.h"

namespace hapticwall {

// The replaceable parts of a tick. Realtime-safe: yes, except the constructor.
struct TickParts {
  ActiveEstimator estimator;
  ActiveEnvironment environment;
  FollowedAlgorithm algorithm;

  void reset() {
    estimator.reset();
    environment.reset();
    algorithm.reset();
  }
  // The signals of the last tick, and no others.
  void show(Signals& signals) const {
    algorithm.show(signals);
    environment.show(signals);
  }
};

// Result of a tick. ServoState has the ledger after it.
struct TickOutcome {
  std::uint64_t tick = 0;
  double position_m = 0.0;
  double age_s = 0.0;            // of the position
  double device_time_s = 0.0;    // of the position, by the device's clock
  double applied_force_n = 0.0;  // as the device reports it
  double displacement_m = 0.0;
  double velocity_m_per_s = 0.0;
  WallContact contact;
  double force_n = 0.0;  // as commanded
  bool intervened = false;
  bool saturated = false;
  bool stale = false;
  bool fault = false;
  bool parameters_changed = false;
  bool rate_limited = false;
};

namespace detail {

// Limits the rise from the previous force of the same sign, else from zero. Realtime-safe: yes.
[[nodiscard]] inline double limit_rise(double force_n, double previous_n, double max_rise_n) {
  const bool same_sign = (force_n > 0.0) == (previous_n > 0.0);
  const double from_n = same_sign ? std::abs(previous_n) : 0.0;
  return std::clamp(force_n, -from_n - max_rise_n, from_n + max_rise_n);
}

// Finite check, then clamp; zero if the input is not usable. Realtime-safe: yes.
[[nodiscard]] inline double restrict_force(double wanted_n, double limit_n, bool usable,
                                           ServoState& state) {
  if (!std::isfinite(wanted_n)) state.failed = true;
  if (state.failed || !usable) return 0.0;
  return std::clamp(wanted_n, -limit_n, limit_n);
}

// Clamps a force before it is blended: a stiff wall's excess over the limit would stay in the
// offset and pull in a handle that leaves. Keeps NaN and infinity. Realtime-safe: yes.
[[nodiscard]] inline double within(double wanted_n, double limit_n) {
  return std::isfinite(wanted_n) ? std::clamp(wanted_n, -limit_n, limit_n) : wanted_n;
}

// The previous force as the algorithm knows it. Realtime-safe: yes.
[[nodiscard]] inline double previous_force(const ServoState& state) {
  if (state.previous_level == 1.0) [[likely]]
    return state.previous_force_n;
  return state.previous_force_n / state.previous_level;
}

// The previous force at a gain of 1. Realtime-safe: yes.
[[nodiscard]] inline double previous_full_force(const ServoState& state, double limit_n) {
  const double force_n = previous_force(state);
  if (state.previous_gain == 1.0) return force_n;
  if (state.previous_gain == 0.0) return 0.0;
  return std::clamp(force_n / state.previous_gain, -limit_n, limit_n);
}

// Gives no negative zero and keeps NaN and infinity. Realtime-safe: yes.
[[nodiscard]] inline double scale_force(double wanted_n, double gain) {
  return gain == 0.0 && std::isfinite(wanted_n) ? 0.0 : wanted_n * gain;
}

// The parts of a tick, in order. Realtime-safe: yes.
[[gnu::always_inline]] inline void take_reading(const ServoSettings& settings,
                                                const ServoState& state,
                                                const DeviceReading& reading, TickOutcome& out) {
  out.tick = state.tick;
  out.stale = !(reading.age_s <= settings.maximum_age_s);
  out.fault = reading.state != DeviceState::kOk || !std::isfinite(reading.position_m);
  out.age_s = reading.age_s;
  out.device_time_s = reading.device_time_s;
  out.applied_force_n = reading.applied_force_n;
  out.position_m = out.fault ? state.previous_position_m : reading.position_m;
  out.displacement_m = state.position_known ? out.position_m - state.previous_position_m : 0.0;
}

// The input of the algorithm, but for what an environment and another axis add. `displacement_m`:
// since the last computation.
[[gnu::always_inline]] inline AlgorithmInput algorithm_input(const ServoState& state,
                                                             double displacement_m,
                                                             const TickOutcome& out) {
  return {
      out.contact.force_n,       out.position_m,        displacement_m,        out.velocity_m_per_s,
      out.contact.penetration_m, previous_force(state), out.contact.in_contact};
}

// Estimator, walls and algorithm: the force that the algorithm wants.
[[gnu::always_inline]] inline double compute_force(const ServoSettings& settings,
                                                   const ServoState& state, TickParts& parts,
                                                   TickOutcome& out) {
  out.velocity_m_per_s = parts.estimator.velocity(out.position_m, out.displacement_m);
  out.contact = evaluate_walls(settings.walls, out.position_m, out.velocity_m_per_s);
  const double wanted_n = parts.algorithm.step(algorithm_input(state, out.displacement_m, out));
  out.intervened = wanted_n != out.contact.force_n;
  return wanted_n;
}

// A tick by value, so that the state of an ideal loop needs no address.
struct OpenTick {
  ServoState state;
  TickOutcome out;
  double displacement_m = 0.0;  // since the last computation
  bool computes = true;         // false: the controller skips this tick
  double wanted_n = 0.0;
};

// The parts of compute_force() for a loop that is not plain(). A skipped tick knows where the
// handle is, and has velocity and force of the last computation.
inline void take_velocity(const ServoSettings& settings, TickParts& parts, OpenTick& tick) {
  LastComputation& last = tick.state.last;
  tick.displacement_m = last.displacement_m += tick.out.displacement_m;
  tick.computes =
      last.outdated || !settings.skipped.any() || !settings.skipped.has(tick.state.tick);
  if (tick.computes) {
    last.displacement_m = 0.0;
    last.velocity_m_per_s = parts.estimator.velocity(tick.out.position_m, tick.displacement_m);
  }
  tick.out.velocity_m_per_s = last.velocity_m_per_s;
}

// `other`: the other axis of the scene at this tick; nullptr: none, or not asked for.
inline void take_contact(const ServoSettings& settings, TickParts& parts, const OpenTick* other,
                         OpenTick& tick) {
  TickOutcome& out = tick.out;
  if (settings.environment == nullptr) {
    out.contact = evaluate_walls(settings.walls, out.position_m, out.velocity_m_per_s);
    return;
  }
  EnvironmentMotion motion{settings.axis, other != nullptr,
                           static_cast<double>(out.tick) / settings.rate_hz, out.position_m,
                           out.velocity_m_per_s};
  if (other != nullptr) {
    motion.other_position_m = other->out.position_m;
    motion.other_velocity_m_per_s = other->out.velocity_m_per_s;
  }
  parts.environment.look(motion, tick.computes);
  out.contact = parts.environment.contact();
  // An algorithm may turn NaN into a finite force: energy-bounding adds its bound to the last one.
  if (!std::isfinite(out.contact.force_n)) tick.state.failed = true;
}

inline void take_force(const ServoSettings& settings, TickParts& parts, const OtherAxis* other,
                       OpenTick& tick) {
  LastComputation& last = tick.state.last;
  TickOutcome& out = tick.out;
  if (tick.computes) {
    AlgorithmInput input = algorithm_input(tick.state, tick.displacement_m, out);
    if (settings.environment != nullptr) input.environment = &parts.environment;
    input.other = other;
    last.wanted_n = parts.algorithm.step(input);
    last.intervened = last.wanted_n != out.contact.force_n;
  }
  out.intervened = last.intervened;
  last.outdated = out.stale || out.fault;
  tick.wanted_n = last.wanted_n;
}

// The force of a loop that is not plain().
[[gnu::noinline]] inline OpenTick compute_openly(const ServoSettings& settings, OpenTick tick,
                                                 TickParts& parts) {
  take_velocity(settings, parts, tick);
  take_contact(settings, parts, nullptr, tick);
  take_force(settings, parts, nullptr, tick);
  return tick;
}

// Turns the algorithm's force into out.force_n: blended, armed, limited.
[[gnu::always_inline]] inline void make_safe(const ServoSettings& settings, ServoState& state,
                                             double wanted_n, TickOutcome& out) {
  double limit_n = settings.force_limit_n;
  limit_n *= state.limit_share;
  if (state.transition.ticks_left > 0) [[unlikely]] {
    out.saturated = std::abs(wanted_n) > limit_n;
    wanted_n =
        state.transition.blend(within(wanted_n, limit_n), previous_full_force(state, limit_n));
  }
  if (state.force_gain < 1.0) [[unlikely]] {
    wanted_n = scale_force(wanted_n, state.force_gain);
    // A stiff wall reaches its limit at once, so the limit rises too.
    limit_n *= state.force_gain;
  }
  out.force_n = wanted_n;
  if (out.stale || out.fault || state.failed || !(std::abs(wanted_n) <= limit_n)) [[unlikely]] {
    out.saturated = out.saturated || std::abs(wanted_n) > limit_n;
    out.force_n = restrict_force(wanted_n, limit_n, !out.stale && !out.fault, state);
  }
  out.force_n *= state.level;
  if (std::isfinite(settings.max_rise_n)) [[unlikely]] {
    const double risen_n = limit_rise(out.force_n, state.previous_force_n, settings.max_rise_n);
    out.rate_limited = risen_n != out.force_n;
    out.force_n = risen_n;
  }
}

// Ends the tick: the ledger gets the commanded force, and the next tick its predecessor.
[[gnu::always_inline]] inline void remember(ServoState& state, TickOutcome& out) {
  state.ledger.add(out.force_n, state.previous_force_n, out.displacement_m, state.budget_n_per_m);
  state.previous_position_m = out.position_m;
  state.previous_force_n = out.force_n;
  state.previous_gain = state.force_gain;
  state.previous_level = state.level;
  // Motion during a fault is unobserved: the first reading after it has zero displacement.
  state.position_known = !out.fault;
  out.parameters_changed = state.parameters_changed;
  state.parameters_changed = false;
  ++state.tick;
}

// The end of a tick, from the force that the algorithm wants.
template <typename Device>
[[gnu::always_inline]] inline void finish(const ServoSettings& settings, ServoState& state,
                                          TickParts& parts, double wanted_n, TickOutcome& out,
                                          Device& device) {
  make_safe(settings, state, wanted_n, out);
  device.write(out.force_n);
  if (settings.environment != nullptr) [[unlikely]] {
    // While no force may act, what is touched has no motion: it begins anew when it may.
    state.force_gain > 0.0 ? parts.environment.advance(out.force_n) : parts.environment.reset();
  }
  remember(state, out);
}

}  // namespace detail

// One tick. `device` has `DeviceReading read()` and `void write(double)`. Realtime-safe: yes, if
// the device is.
template <typename Device>
[[gnu::always_inline]] inline TickOutcome servo_step(const ServoSettings& settings,
                                                     ServoState& state, TickParts& parts,
                                                     Device& device) {
  TickOutcome out;
  detail::take_reading(settings, state, device.read(), out);
  double wanted_n = 0.0;
  if (!settings.plain()) [[unlikely]] {
    const detail::OpenTick tick = detail::compute_openly(settings, {state, out}, parts);
    state = tick.state;
    out = tick.out;
    wanted_n = tick.wanted_n;
  } else {
    wanted_n = detail::compute_force(settings, state, parts, out);
  }
  detail::finish(settings, state, parts, wanted_n, out, device);
  return out;
}

// The tick as plotted and recorded; the caller adds truth and generation. Realtime-safe: yes.
inline void write_sample(const ServoSettings& settings, const EnergyLedger& ledger,
                         const TickOutcome& out, Sample& sample) {
  sample.tick = out.tick;
  sample.time_s = static_cast<double>(out.tick) / settings.rate_hz;
  sample.position_m = out.position_m;
  sample.velocity_m_per_s = out.velocity_m_per_s;
  sample.penetration_m = out.contact.penetration_m;
  sample.wall_force_n = out.contact.force_n;
  sample.force_n = out.force_n;
  // A denormal penetration gives an infinite quotient; a recording holds finite numbers only.
  constexpr double kMax = std::numeric_limits<double>::max();
  sample.stiffness_n_per_m = out.contact.in_contact && out.contact.penetration_m != 0.0
                                 ? std::clamp(out.force_n / out.contact.penetration_m, -kMax, kMax)
                                 : 0.0;
  sample.energy_cv_j = ledger.cv_j;
  sample.energy_hold_j = ledger.hold_j;
  sample.energy_scv_j = ledger.scv_j;
  sample.energy_budget_j = ledger.budget_j;
  sample.device_time_s = out.device_time_s;
  sample.read_age_s = out.age_s;
  sample.applied_force_n = out.applied_force_n;
  const auto flag = [](bool set, SampleFlag bit) {
    return set ? static_cast<std::uint32_t>(bit) : 0U;
  };
  sample.flags = flag(out.contact.in_contact, kFlagInContact) |
                 flag(out.saturated, kFlagForceLimit) | flag(out.intervened, kFlagIntervened) |
                 flag(out.stale, kFlagStaleInput) | flag(out.fault, kFlagDeviceFault) |
                 flag(out.parameters_changed, kFlagParametersChanged) |
                 flag(out.rate_limited, kFlagForceRate);
}

}  // namespace hapticwall
