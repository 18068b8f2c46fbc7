// Contact traces of two slots: the last contact of each, so that one can be drawn over the other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/compare/blind_trials.h"
#include "core/algorithm_settings.h"
#include "core/sample.h"
#include "core/tick/energy_ledger.h"

namespace hapticwall::compare {

// "energy-bounding (rest_force_step_n = 0.01)": the algorithm with the keys that are set.
[[nodiscard]] std::string describe(const AlgorithmSettings& settings);

// A tick of a contact. Energies count from the start of the contact.
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

// The ghost: points of the other slot, each at present_onset_tick + point.ticks.
struct Ghost {
  Slot slot = Slot::kA;
  std::uint64_t present_onset_tick = 0;
  std::span<const TracePoint> points;  // valid until the next add()
  EnergyLedger before;  // ledger at the start of the present contact; add it to the points
};

// Only the constructor may throw (no memory); add() does not allocate.
class ContactTraces {
 public:
  // Shorter pauses without contact and force are chatter of the same contact.
  static constexpr double kRestS = 0.25;
  // Length of the trace from the start of the contact.
  static constexpr double kTraceS = 8.0;
  static constexpr std::size_t kMaxTracePoints = 32768;

  ContactTraces(const AlgorithmSettings& a, const AlgorithmSettings& b, double rate_hz);

  [[nodiscard]] Slot active() const { return active_; }
  [[nodiscard]] const AlgorithmSettings& settings(Slot slot) const {
    return slots_[index(slot)].settings;
  }
  // Does not change the session.
  void set_settings(Slot slot, const AlgorithmSettings& settings) {
    slots_[index(slot)].settings = settings;
  }

  // Activates `slot` and returns the algorithm for the session. Samples belong to the previous slot
  // until their generation changes, because the loop has not seen the change yet.
  const AlgorithmSettings& activate(Slot slot);
  const AlgorithmSettings& toggle() { return activate(other(active_)); }

  // Call it with every sample, in order. A change of parameters or a reset ends the trace of a
  // contact.
  void add(const Sample& sample);

  // The newest contact of a slot, from its start.
  [[nodiscard]] std::span<const TracePoint> trace(Slot slot) const {
    return slots_[index(slot)].trace;
  }
  // nullopt before the first contact, after a reset, and without a contact of the other slot.
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
  Slot sampled_ = Slot::kA;  // slot of the incoming samples
  bool has_previous_ = false;
  Sample previous_;
  Sample before_onset_;
  std::optional<std::uint64_t> onset_tick_;
  std::uint64_t resting_ticks_ = 0;
  bool tracing_ = false;
};

}  // namespace hapticwall::compare
