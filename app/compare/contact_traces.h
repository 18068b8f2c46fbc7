// Two algorithms felt in turn: two slots, a toggle, and the last contact of each, so that the other
// one's can be drawn over the present one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/runtime/comparison_trials.h"
#include "core/energy_ledger.h"
#include "core/sample.h"
#include "core/stabiliser/algorithm_settings.h"

namespace hapticwall::runtime {

// "energy-bounding (rest_force_step_n = 0.01)": with the keys that are set.
[[nodiscard]] std::string describe(const AlgorithmSettings& settings);

// A tick of a contact. The energies are those since the contact began.
struct TracePoint {
  std::uint32_t ticks = 0;  // since the contact began
  double position_m = 0.0;
  double penetration_m = 0.0;
  double force_n = 0.0;
  double stiffness_n_per_m = 0.0;
  double energy_cv_j = 0.0;
  double energy_hold_j = 0.0;
  double energy_scv_j = 0.0;
  double energy_budget_j = 0.0;
};

// What is drawn as a ghost: points of the other slot, each at present_onset_tick + point.ticks.
struct Ghost {
  Slot slot = Slot::kA;
  std::uint64_t present_onset_tick = 0;
  std::span<const TracePoint> points;  // valid until the next add()
  EnergyLedger before;                 // the present contact's, to which the points' are added
};

// No member throws but for want of memory at construction; add() does not allocate.
class Comparison {
 public:
  // A contact after less than this without contact and force is the same one: chatter.
  static constexpr double kRestS = 0.25;
  // A contact is kept for this long from its beginning on.
  static constexpr double kTraceS = 8.0;
  static constexpr std::size_t kMostTracePoints = 32768;

  Comparison(const AlgorithmSettings& a, const AlgorithmSettings& b, double rate_hz);

  [[nodiscard]] Slot active() const { return active_; }
  [[nodiscard]] const AlgorithmSettings& settings(Slot slot) const {
    return slots_[index(slot)].settings;
  }
  // Of either slot; what the session runs is the caller's business.
  void set_settings(Slot slot, const AlgorithmSettings& settings) {
    slots_[index(slot)].settings = settings;
  }

  // Makes `slot` the active one and returns what the session is to run now. The samples that
  // follow belong to the slot before until the parameters that they were made with change
  // (Sample::generation): the loop has not seen the change yet.
  const AlgorithmSettings& activate(Slot slot);
  const AlgorithmSettings& toggle() { return activate(other(active_)); }

  // Every sample of the session, in order. A change of parameters ends the trace of a contact: what
  // follows is neither slot's. So does a reset.
  void add(const Sample& sample);

  // The newest contact of a slot, from its beginning on.
  [[nodiscard]] std::span<const TracePoint> trace(Slot slot) const {
    return slots_[index(slot)].trace;
  }
  // Nothing before the first contact, after a reset, and without a contact of the other slot.
  [[nodiscard]] std::optional<Ghost> ghost() const;

 private:
  struct Contents {
    AlgorithmSettings settings;
    std::vector<TracePoint> trace;
  };
  [[nodiscard]] static constexpr std::size_t index(Slot slot) {
    return static_cast<std::size_t>(slot);
  }
  void note_changes(const Sample& sample);
  void begin_contact(const Sample& sample);
  void append(const Sample& sample);

  std::array<Contents, 2> slots_;
  std::size_t most_points_;
  std::uint64_t rest_ticks_;
  Slot active_ = Slot::kA;
  Slot sampled_ = Slot::kA;  // whose samples come in
  bool has_previous_ = false;
  Sample previous_;
  Sample before_onset_;
  std::optional<std::uint64_t> onset_tick_;
  std::uint64_t resting_ticks_ = 0;
  bool tracing_ = false;
};

}  // namespace hapticwall::runtime
