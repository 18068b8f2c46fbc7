// Arming of a real device. The force starts off, turns on at the person's request if the handle is
// outside the wall, ramps up, and turns off at the first problem. A simulator needs no arming.
// Arithmetic only: no clock, no device. Realtime-safe: yes, all of it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/sample.h"

namespace hapticwall::session {

// Time from zero to full force.
inline constexpr double kArmingRampS = 0.5;

enum class ArmingState : std::uint8_t {
  kNotNeeded,  // a simulator: the force always acts
  kOff,
  kRamping,
  kOn
};

// Why the force is off.
enum class ArmingNote : std::uint8_t {
  kNone,        // the force acts, or was never requested
  kAsked,       // the person asked for it
  kInsideWall,  // refused: the handle was inside the wall
  kNotReady,    // refused: the device gave no valid position
  kPaused,      // refused or disarmed by a pause
  kStale,       // the newest position was too old
  kDevice,      // the device reported a fault, or was lost
  kForce,       // the algorithm's force was not a finite number
  kWallMoved,   // a change of parameters put the wall over the handle
  kLate,        // the loop woke up later than the time to live of a force
  // Faults that DeviceJudge found.
  kImplausible,
  kSlowAnswer,
  kNoAnswer,
  kNotEnabled,
  kNoForce,
  kRejected,
  kOtherForce,
  kGivesWay,
  kWrongWay,
  kAcceleration,
  kClockRate,
  kClockJump,
  kSlowDevice,
  kSlowerAnswer,
  kUnaskedForce
};

// A clause for people, in the order of ArmingNote.
inline constexpr auto kArmingNoteTexts = std::to_array<std::string_view>({
    "",
    "switched off",
    "the handle is inside the wall: move it out first",
    "the device gives no valid position",
    "the session is paused",
    "the newest position was too old",
    "the device was lost or reported a fault",
    "the force was not a finite number",
    "the change would have put the wall over the handle",
    "the program was held up for too long",
    "the position jumped farther than the handle can move",
    "commands take longer than 20 ms to act",
    "the device acknowledges no command",
    "the device says that it is not enabled",
    "the device says that it gives no force",
    "the device rejects commands",
    "the device says that it gives another force than the commanded one",
    "the handle moves against the full force: the device takes no commands, or has another sign",
    "the handle moves the other way than the force: exchange the sign of the force",
    "the position changed its speed faster than a hand can: check the encoder",
    "the clock of the device runs at another rate than the one of this machine",
    "the clock of the device jumped",
    "the force acts more than 5 ticks late: --allow-slow-device drives the device anyway",
    "commands act later than when the force was armed",
    "the device says that it gives a force while it is disarmed",
});
static_assert(kArmingNoteTexts.size() == static_cast<std::size_t>(ArmingNote::kUnaskedForce) + 1);

// Empty for kNone.
[[nodiscard]] constexpr std::string_view arming_note_text(ArmingNote note) {
  return kArmingNoteTexts.at(static_cast<std::size_t>(note));
}

// The facts of a tick that arming depends on.
struct ArmingFacts {
  bool fault = false;
  bool stale = false;
  bool failed = false;  // the force was not finite
  bool in_contact = false;
  bool parameters_changed = false;
  ArmingNote judged = ArmingNote::kNone;  // fault that DeviceJudge found
  bool waits_for_answer = false;          // the delay of the device is not known yet
};
// Another environment than the walls may touch the handle everywhere: there a force above this one
// counts as a contact.
inline constexpr double kArmingForceN = 0.3;
[[nodiscard]] inline ArmingFacts arming_facts(const Sample& sample, bool failed, bool in_walls) {
  const bool touches =
      in_walls ? sample.penetration_m > 0.0 : !(std::abs(sample.wall_force_n) <= kArmingForceN);
  const auto has = [&](SampleFlag flag) { return (sample.flags & flag) != 0; };
  return {has(kFlagDeviceFault),       has(kFlagStaleInput), failed, touches,
          has(kFlagParametersChanged), ArmingNote::kNone,    false};
}

class Arming {
 public:
  // `rate_hz`: of the ticks, positive.
  Arming(bool needed, double rate_hz)
      : state_(needed ? ArmingState::kOff : ArmingState::kNotNeeded),
        gain_step_(1.0 / std::max(1.0, std::round(kArmingRampS * rate_hz))) {}

  // Asks for the force. The next tick decides, when the position of the handle is known.
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

  // Call after every tick. True if it disarmed: the caller must disable the device at once.
  bool after_tick(const ArmingFacts& facts) {
    if (state_ == ArmingState::kNotNeeded) return false;
    const ArmingNote trouble = trouble_in(facts);
    was_in_contact_ = facts.in_contact;
    if (state_ == ArmingState::kOff) {
      if (asked_) answer(facts);
      if (facts.judged == ArmingNote::kUnaskedForce && !has_objection()) note_ = facts.judged;
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
  // True if the device may apply the commanded force.
  [[nodiscard]] bool enabled() const { return state_ != ArmingState::kOff; }
  // Number of answered requests, granted or refused.
  [[nodiscard]] std::uint32_t answers() const { return answers_; }
  // Gain of the force at the next tick, 0 to 1.
  [[nodiscard]] double gain() const { return state_ == ArmingState::kNotNeeded ? 1.0 : gain_; }

 private:
  // While the force is on. Contact alone is no problem.
  [[nodiscard]] ArmingNote trouble_in(const ArmingFacts& facts) const {
    if (facts.judged != ArmingNote::kNone) return facts.judged;
    if (facts.fault) return ArmingNote::kDevice;
    if (facts.stale) return ArmingNote::kStale;
    if (facts.failed) return ArmingNote::kForce;
    if (facts.parameters_changed && facts.in_contact && !was_in_contact_) {
      return ArmingNote::kWallMoved;
    }
    return ArmingNote::kNone;
  }

  // The note says what is wrong, so that no other one takes its place.
  [[nodiscard]] bool has_objection() const {
    return note_ != ArmingNote::kNone && note_ != ArmingNote::kAsked &&
           note_ != ArmingNote::kInsideWall && note_ != ArmingNote::kPaused;
  }

  void answer(const ArmingFacts& facts) {
    const bool troubled = facts.judged != ArmingNote::kNone || facts.fault || facts.stale;
    if (facts.waits_for_answer && !troubled) return;
    asked_ = false;
    ++answers_;
    if (facts.judged != ArmingNote::kNone) {
      note_ = facts.judged;
    } else if (facts.fault || facts.stale) {
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

}  // namespace hapticwall::session
