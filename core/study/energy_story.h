// What the ledger says in a word: one lamp.
//
// All of it is what a controller can see: measured displacements, its own forces, and the damping
// that its algorithm believes in. From a beginning at which the virtual wall stores nothing,
//
//   scv = cv + hold                    what handle and actuator exchanged       [paper, Eq. 10]
//   scv - budget = scv + T Σ b v²      with what the device's damping has eaten [paper, Eq. 16, 22]
//
// The second is the least that the hand must have put in. So
//
//   passive            scv >= 0: the computer has taken in at least what it gave out
//   spending budget    budget <= scv < 0: it gave out more, but the device's damping ate all of
//   that active             scv < budget: the hand has taken out budget - scv, and nobody had put
//   it in
//
// Because budget - scv = (budget - hold) + (-cv), what the hand took can only come from two terms:
// the hold, by as much as it went beyond its budget, and the control law, by as much as cv fell
// below zero. The energy bounding algorithm keeps the first at zero, always; the passivity observer
// watches the second alone. Where one term is in credit, it has paid for a part of the other's
// debt, and then a part is larger than what the hand took.
//
// The encoder sees multiples of its resolution only: what the hand took is called `active` from
// `resolution_j` on, what one count carries under the largest force.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/energy_ledger.h"
#include "core/sample.h"

namespace hapticwall {

enum class EnergyState : std::uint8_t { kPassive, kSpendingBudget, kActive };
enum class EnergyBlame : std::uint8_t { kNobody, kHold, kControlLaw, kBoth };

// Joules; none is negative.
struct EnergyStory {
  EnergyState state = EnergyState::kPassive;
  EnergyBlame blame = EnergyBlame::kNobody;  // other than nobody's only while active
  double extracted_j = 0.0;                  // by the hand; 0 unless active
  double hold_beyond_budget_j = 0.0;         // also while cv still covers it
  double control_law_j = 0.0;                // -cv, where that is positive
  double given_out_j = 0.0;                  // -scv, where that is positive
  double budget_j = 0.0;                     // what the device's damping has eaten
};

// From `since` to `now`, two rows of one ledger; `since` is a row at which the wall stores nothing
// (the all-zero row of the start). Realtime-safe: yes.
[[nodiscard]] EnergyStory tell_energy_story(const EnergyLedger& now, const EnergyLedger& since = {},
                                            double resolution_j = 0.0);

// Realtime-safe: yes.
[[nodiscard]] inline EnergyLedger ledger_of(const Sample& sample) {
  return {sample.energy_cv_j, sample.energy_hold_j, sample.energy_scv_j, sample.energy_budget_j};
}

// The lamp beside a running session: the story of the present contact, and between contacts that of
// the last one. Free motion before it would lend it a budget that the contact has not earned, and
// an earlier contact its guilt; so the story begins anew
//   - with the first sample, and where the ticks go back (reset, another recording);
//   - where a contact begins after kRestS without contact and force: then nothing is stored;
//   - where parameters change: the wall may store energy then, and is lent F p/2 for it, that of a
//     spring with this force at this penetration.
// Realtime-safe: yes, all of it.
class EnergyLamp {
 public:
  // Chatter leaves the wall for less than this.
  static constexpr double kRestS = 0.25;

  // `encoder_m`: 0 without an encoder.
  EnergyLamp(double rate_hz, double encoder_m)
      : rest_ticks_(static_cast<std::uint64_t>(std::ceil(kRestS * rate_hz))),
        encoder_m_(encoder_m) {}

  // Every tick, in order.
  void add(const Sample& sample);

  [[nodiscard]] const EnergyStory& story() const { return story_; }
  // Where the story begins.
  [[nodiscard]] std::uint64_t since_tick() const { return since_tick_; }

 private:
  void begin_at(const Sample& sample);
  [[nodiscard]] bool contact_begins(const Sample& sample) const;

  std::uint64_t rest_ticks_;
  double encoder_m_;
  bool has_previous_ = false;
  Sample previous_;
  EnergyLedger since_;
  std::uint64_t since_tick_ = 0;
  std::uint64_t resting_ticks_ = 0;  // without contact and force, up to now
  double peak_force_n_ = 0.0;
  EnergyStory story_;
};

}  // namespace hapticwall
