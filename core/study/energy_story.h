// Summary of the energy ledger in one state, for the lamp.
//
// It uses only quantities that a controller knows: measured displacements, its own forces, and the
// damping that its algorithm assumes. From a start at which the virtual wall stores no energy,
//
//   scv = cv + hold                  exchange of handle and actuator         [paper, Eq. 10]
//   scv - budget = scv + T Σ b v²    plus the dissipation of the damping     [paper, Eq. 16, 22]
//
// The second is a lower bound of the hand's work. So
//
//   passive           scv >= 0: the computer absorbed at least what it gave out
//   spending budget   budget <= scv < 0: the device damping dissipated the difference
//   active            scv < budget: the hand extracted budget - scv
//
// Because budget - scv = (budget - hold) + (-cv), the extracted energy has two sources: the hold
// beyond its budget, and the control law below zero. The energy bounding algorithm keeps the first
// at zero; the passivity observer watches only the second. A term in credit covers part of the
// other's debt; then one part exceeds the extracted energy.
//
// The encoder shows only multiples of its resolution. The state is therefore `active` only from
// `resolution_j` on: the energy of one count under the largest force.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/sample.h"
#include "core/tick/energy_ledger.h"

namespace hapticwall {

enum class EnergyState : std::uint8_t { kPassive, kSpendingBudget, kActive };
enum class EnergyBlame : std::uint8_t { kNobody, kHold, kControlLaw, kBoth };

// Joules; none is negative.
struct EnergyStory {
  EnergyState state = EnergyState::kPassive;
  EnergyBlame blame = EnergyBlame::kNobody;  // kNobody unless active
  double extracted_j = 0.0;                  // by the hand; 0 unless active
  double hold_beyond_budget_j = 0.0;         // also while cv covers it
  double control_law_j = 0.0;                // max(0, -cv)
  double given_out_j = 0.0;                  // max(0, -scv)
  double budget_j = 0.0;                     // dissipated by the device damping
  double tolerance_j = 0.0;                  // energy that the encoder cannot show: `resolution_j`
};

// Story from `since` to `now`, two rows of one ledger. The wall must store no energy at `since`
// (default: the start). Realtime-safe: yes.
[[nodiscard]] EnergyStory tell_energy_story(const EnergyLedger& now, const EnergyLedger& since = {},
                                            double resolution_j = 0.0);

// The lamp of a session: the story of the present contact or, between contacts, of the last one.
// Free motion and earlier contacts must not affect its budget or its debt. The story therefore
// restarts
//   - with the first sample, and when the ticks go back (reset, another recording);
//   - at a contact after kRestS without contact and force: the wall then stores no energy;
//   - at a change of parameters: the wall may store energy, which is estimated as F p/2, that of a
//     spring with this force at this penetration.
// Realtime-safe: yes, all of it.
class EnergyLamp {
 public:
  // Chatter leaves the wall for a shorter time.
  static constexpr double kRestS = 0.25;

  // `encoder_m`: 0 without an encoder.
  EnergyLamp(double rate_hz, double encoder_m)
      : rest_ticks_(static_cast<std::uint64_t>(std::ceil(kRestS * rate_hz))),
        encoder_m_(encoder_m) {}

  // Call for every tick, in order.
  void add(const Sample& sample);

  [[nodiscard]] const EnergyStory& story() const { return story_; }
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
