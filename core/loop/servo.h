// The controller of one axis: settings, all algorithms, the ledger; and its tick.
#pragma once

#include "core/servo_step.h"
#include "core/stabiliser/followed_stabiliser.h"

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

// Owns every algorithm and the state of the loop. Trivial to move at set-up, never allocates.
// Realtime-safe: yes, all of it (constructor included).
class Servo {
 public:
  explicit Servo(const ServoSettings& settings);

  // Takes new settings at a tick boundary; the rate must be the old one. A change of algorithm
  // resets the new one and what follows it; a follower that is put behind begins anew, too. Any
  // change starts a transition in which the force begins exactly where it was (no kick) and blends
  // into the new law's over settings.transition_s. Settings that are the old ones change no bit of
  // what follows.
  void apply(const ServoSettings& settings);

  // Back to tick 0: algorithms, ledger and previous force are forgotten.
  void reset();

  [[nodiscard]] const ServoSettings& settings() const { return settings_; }

  // One tick against a device: `DeviceReading read()`, `void write(double force_n)`, and optionally
  // `const PlantTruth* truth()`. Returns the tick's sample (generation left 0).
  template <typename Device>
  Sample tick(Device& device) {
    return with_algorithm([&](auto& stabiliser) {
      // The truth is that of the instant of the reading: a simulator's write() lets the tick pass.
      Sample sample;
      TruthKeeper<Device> keeper{device, sample};
      const TickOutcome outcome = servo_step(settings_, state_, stabiliser, keeper);
      write_sample(settings_, state_.ledger, outcome, sample);
      return sample;
    });
  }

  // For a loop of its own around servo_step(): calls `visitor` with the algorithm in force.
  template <typename Visitor>
  decltype(auto) with_algorithm(Visitor&& visitor) {
    if (followed_) [[unlikely]] {
      FollowedStabiliser both(stabilisers_, settings_.algorithm.index, follower_);
      return visitor(both);
    }
    return stabilisers_.visit(settings_.algorithm.index, std::forward<Visitor>(visitor));
  }
  [[nodiscard]] ServoState& state() { return state_; }
  [[nodiscard]] const ServoState& state() const { return state_; }

 private:
  void configure();

  ServoSettings settings_;
  ServoState state_;
  StabiliserBank stabilisers_;
  PassivityControl follower_;  // of `then`, with a state of its own
  bool followed_ = false;
};

}  // namespace hapticwall
