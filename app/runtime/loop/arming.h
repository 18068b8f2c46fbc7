// Whether a real device's force may act: off at first, on only when the person asks for it with the
// handle outside the wall, full only after a ramp, off again at the first thing that is wrong.
//
// A simulator needs none of it: nobody's hand is there, and its runs repeat bit for bit from tick 0
// on. Arithmetic only: no clock, no device. Realtime-safe: yes, all of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "core/sample.h"

namespace hapticwall::runtime {

// From no force to all of it.
inline constexpr double kArmingRampS = 0.5;

enum class ArmingState : std::uint8_t {
  kNotNeeded,  // a simulator: the force always acts
  kOff,
  kRamping,
  kOn
};

// Why the force is off.
enum class ArmingNote : std::uint8_t {
  kNone,        // it is not off, or was never asked for
  kAsked,       // by the person
  kInsideWall,  // refused: the handle was inside the wall
  kNotReady,    // refused: the device gave no position that may be acted upon
  kPaused,      // refused while paused, or taken away by the pause
  kStale,       // the newest position was too old
  kDevice,      // the device reported a fault, or was lost
  kForce,       // the algorithm's force was not a finite number
  kWallMoved,   // a change of parameters put the wall over the handle
  kLate         // the loop was not woken for longer than a force may stand
};

// A clause for people: "the handle was inside the wall". Empty for kNone.
[[nodiscard]] std::string_view arming_note_text(ArmingNote note);

// What a tick has shown that matters here.
struct ArmingFacts {
  bool fault = false;
  bool stale = false;
  bool failed = false;  // the force was not finite
  bool in_contact = false;
  bool parameters_changed = false;
};
[[nodiscard]] inline ArmingFacts arming_facts(const Sample& sample, bool failed) {
  const auto has = [&](SampleFlag flag) { return (sample.flags & flag) != 0; };
  return {has(kFlagDeviceFault), has(kFlagStaleInput), failed, sample.penetration_m > 0.0,
          has(kFlagParametersChanged)};
}

class Arming {
 public:
  // `rate_hz` > 0, of the ticks.
  Arming(bool needed, double rate_hz)
      : state_(needed ? ArmingState::kOff : ArmingState::kNotNeeded),
        gain_step_(1.0 / std::max(1.0, std::round(kArmingRampS * rate_hz))) {}

  // Asks for the force. Judged by the next tick: not before the handle's place is known.
  void ask() {
    if (state_ == ArmingState::kOff) asked_ = true;
  }
  void disarm(ArmingNote why) {
    if (state_ == ArmingState::kNotNeeded) return;
    if (state_ != ArmingState::kOff || asked_) note_ = why;
    if (asked_) ++answers_;
    state_ = ArmingState::kOff;
    asked_ = false;
    gain_ = 0.0;
  }

  // After every tick. Returns true where it took the force away: the device is to be told at once.
  bool after_tick(const ArmingFacts& facts) {
    if (state_ == ArmingState::kNotNeeded) return false;
    const ArmingNote trouble = trouble_in(facts);
    was_in_contact_ = facts.in_contact;
    if (state_ == ArmingState::kOff) {
      if (asked_) answer(facts);
      return false;
    }
    if (trouble != ArmingNote::kNone) {
      disarm(trouble);
      return true;
    }
    gain_ = std::min(1.0, gain_ + gain_step_);
    if (gain_ >= 1.0) state_ = ArmingState::kOn;
    return false;
  }

  [[nodiscard]] ArmingState state() const { return state_; }
  [[nodiscard]] ArmingNote note() const { return note_; }
  // Whether the device may act on what it is told.
  [[nodiscard]] bool enabled() const { return state_ != ArmingState::kOff; }
  // How many requests were answered, either way.
  [[nodiscard]] std::uint32_t answers() const { return answers_; }
  // Of the force at the next tick, 0 to 1.
  [[nodiscard]] double gain() const { return state_ == ArmingState::kNotNeeded ? 1.0 : gain_; }

 private:
  // While the force is on; contact as such is what it is for.
  [[nodiscard]] ArmingNote trouble_in(const ArmingFacts& facts) const {
    if (facts.fault) return ArmingNote::kDevice;
    if (facts.stale) return ArmingNote::kStale;
    if (facts.failed) return ArmingNote::kForce;
    if (facts.parameters_changed && facts.in_contact && !was_in_contact_) {
      return ArmingNote::kWallMoved;
    }
    return ArmingNote::kNone;
  }

  void answer(const ArmingFacts& facts) {
    asked_ = false;
    ++answers_;
    if (facts.fault || facts.stale) {
      note_ = ArmingNote::kNotReady;
    } else if (facts.failed) {
      note_ = ArmingNote::kForce;
    } else if (facts.in_contact) {
      note_ = ArmingNote::kInsideWall;
    } else {
      state_ = ArmingState::kRamping;
      note_ = ArmingNote::kNone;
      gain_ = gain_step_;
    }
  }

  ArmingState state_;
  ArmingNote note_ = ArmingNote::kNone;
  bool asked_ = false;
  bool was_in_contact_ = false;
  std::uint32_t answers_ = 0;
  double gain_ = 0.0;
  double gain_step_;
};

}  // namespace hapticwall::runtime
