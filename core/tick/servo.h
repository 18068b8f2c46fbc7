// The controller of one axis: settings, algorithm, ledger and tick.
#pragma once

#include <array>

#include "core/tick/servo_settings.h"
#include "core/tick/servo_state.h"
#include "core/tick/servo_step.h"

namespace hapticwall {

// Copies a simulator's truth into the sample between read and write.
template <typename Device>
struct TruthKeeper {
  Device& device;
  Sample& sample;

  [[nodiscard]] DeviceReading read() { return device.read(); }
  void write(double force_n) {
    if constexpr (requires { device.truth(); }) {
      if (const PlantTruth* truth = device.truth()) sample.truth = *truth;
    }
    device.write(force_n);
  }
};

// Owns the algorithm and the state of the loop. Realtime-safe: yes, except the constructor.
class Servo {
 public:
  explicit Servo(const ServoSettings& settings);

  // Takes new settings at a tick boundary; the rate must stay the same. A change of algorithm or
  // follower starts them anew. Any change starts a transition: the force begins exactly where it
  // was (no kick) and blends into the new algorithm's over settings.transition_s. Equal settings
  // change no bit of the run.
  void apply(const ServoSettings& settings);

  // See FollowedAlgorithm::borrow().
  void borrow(const BorrowedAlgorithm& borrowed) { parts_.algorithm.borrow(borrowed); }

  // Back to tick 0: forgets the state of estimator, environment and algorithm, the ledger and the
  // previous force. The gain of the force stays, so that a reset arms nothing.
  void reset();

  [[nodiscard]] const ServoSettings& settings() const { return settings_; }

  // One tick against a device: `DeviceReading read()`, `void write(double force_n)`, and optionally
  // `const PlantTruth* truth()`. Returns the tick's sample (generation left 0).
  template <typename Device>
  Sample tick(Device& device) {
    // The truth belongs to the instant of the reading: a simulator's write() passes the tick.
    Sample sample;
    TruthKeeper<Device> keeper{device, sample};
    const TickOutcome outcome = servo_step(settings_, state_, parts_, keeper);
    parts_.show(sample.signals);
    write_sample(settings_, state_.ledger, outcome, sample);
    return sample;
  }

  // One tick of two axes that need each other (ServoSettings::both_axes), each against its device
  // as in tick(): both are read before either force is computed. Precondition: the same number of
  // ticks behind both.
  template <typename DeviceX, typename DeviceY>
  static std::array<Sample, 2> tick_together(Servo& x, DeviceX& device_x, Servo& y,
                                             DeviceY& device_y) {
    std::array<Sample, 2> samples;
    detail::OpenTick tick_x = x.open(device_x);
    detail::OpenTick tick_y = y.open(device_y);
    detail::take_contact(x.settings_, x.parts_, &tick_y, tick_x);
    detail::take_contact(y.settings_, y.parts_, &tick_x, tick_y);
    const OtherAxis seen_by_x = y.as_other_axis(tick_y);
    const OtherAxis seen_by_y = x.as_other_axis(tick_x);
    x.close(tick_x, seen_by_x, device_x, samples[0]);
    y.close(tick_y, seen_by_y, device_y, samples[1]);
    return samples;
  }

  // Parts for a loop that calls servo_step() itself.
  [[nodiscard]] TickParts& parts() { return parts_; }
  [[nodiscard]] ServoState& state() { return state_; }
  [[nodiscard]] const ServoState& state() const { return state_; }

 private:
  void configure();

  template <typename Device>
  detail::OpenTick open(Device& device) {
    detail::OpenTick tick{state_, {}};
    detail::take_reading(settings_, tick.state, device.read(), tick.out);
    detail::take_velocity(settings_, parts_, tick);
    return tick;
  }
  [[nodiscard]] OtherAxis as_other_axis(const detail::OpenTick& tick) const {
    return {tick.out.contact.force_n, detail::previous_force(tick.state), tick.displacement_m,
            tick.out.velocity_m_per_s, damping_n_s_per_m_};
  }
  template <typename Device>
  void close(detail::OpenTick& tick, const OtherAxis& other, Device& device, Sample& sample) {
    detail::take_force(settings_, parts_, &other, tick);
    state_ = tick.state;
    TruthKeeper<Device> keeper{device, sample};
    detail::finish(settings_, state_, parts_, tick.wanted_n, tick.out, keeper);
    parts_.show(sample.signals);
    write_sample(settings_, state_.ledger, tick.out, sample);
  }

  ServoSettings settings_;
  ServoState state_;
  TickParts parts_;
  double damping_n_s_per_m_ = 0.0;  // b as the algorithm believes it
};

}  // namespace hapticwall
