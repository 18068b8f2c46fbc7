// The controller of one axis: settings, algorithm, ledger and tick.
#pragma once

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
  void borrow(const BorrowedAlgorithm& borrowed) { algorithm_.borrow(borrowed); }

  // Back to tick 0: forgets the state of estimator and algorithm, the ledger and the previous
  // force. The gain of the force stays, so that a reset arms nothing.
  void reset();

  [[nodiscard]] const ServoSettings& settings() const { return settings_; }

  // One tick against a device: `DeviceReading read()`, `void write(double force_n)`, and optionally
  // `const PlantTruth* truth()`. Returns the tick's sample (generation left 0).
  template <typename Device>
  Sample tick(Device& device) {
    // The truth belongs to the instant of the reading: a simulator's write() passes the tick.
    Sample sample;
    TruthKeeper<Device> keeper{device, sample};
    const TickOutcome outcome = servo_step(settings_, state_, estimator_, algorithm_, keeper);
    algorithm_.show(sample.signals);
    write_sample(settings_, state_.ledger, outcome, sample);
    return sample;
  }

  // Parts for a loop that calls servo_step() itself.
  [[nodiscard]] ActiveEstimator& estimator() { return estimator_; }
  [[nodiscard]] FollowedAlgorithm& algorithm() { return algorithm_; }
  [[nodiscard]] ServoState& state() { return state_; }
  [[nodiscard]] const ServoState& state() const { return state_; }

 private:
  void configure();

  ServoSettings settings_;
  ServoState state_;
  ActiveEstimator estimator_;
  FollowedAlgorithm algorithm_;
};

}  // namespace hapticwall
