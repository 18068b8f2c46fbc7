// Result of a run, and the one list of its keys.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace hapticwall {

// Verdicts from good to bad; docs/verdicts.md defines them.
enum class Verdict : std::uint8_t {
  kSettled,
  kMoving,  // follows a hand that moves
  kNoContact,
  kActive,  // gives the hand energy
  kBuzzing,
  kOscillating,
  kDiverged
};
inline constexpr std::array<std::string_view, 7> kVerdictNames{
    "settled", "moving", "no contact", "active", "buzzing", "oscillating", "diverged"};

[[nodiscard]] constexpr std::string_view verdict_name(Verdict verdict) {
  return kVerdictNames.at(static_cast<std::size_t>(verdict));
}
// nullopt for a word outside kVerdictNames.
[[nodiscard]] constexpr std::optional<Verdict> find_verdict(std::string_view name) {
  const auto found = std::ranges::find(kVerdictNames, name);
  if (found == kVerdictNames.end()) return std::nullopt;
  return static_cast<Verdict>(found - kVerdictNames.begin());
}

// True for a wall that neither chatters nor gives energy, whether the hand rests or moves.
[[nodiscard]] constexpr bool is_good(Verdict verdict) {
  return verdict == Verdict::kSettled || verdict == Verdict::kMoving;
}

// Energy that flowed, by its sums at the end: the scale of a balance error. What flowed to and fro
// in between is not in them.
[[nodiscard]] inline double turnover_j(double hand_work_j, double actuator_work_j,
                                       double dissipation_j, double kinetic_j) {
  return std::abs(hand_work_j) + std::abs(actuator_work_j) + dissipation_j + kinetic_j;
}

// Result of one run along one axis. Fields that do not apply are nullopt.
struct Summary {
  std::string scene;
  std::string algorithm;
  Verdict verdict = Verdict::kSettled;
  std::optional<std::string> verdict_note;  // a note for the reader of the verdict
  double duration_s = 0.0;                  // simulated
  std::uint64_t ticks = 0;                  // fewer than planned if it diverged or was stopped
  std::optional<std::uint64_t> diverged_at_tick;
  // Values from a wall clock; the caller that has one fills them.
  std::optional<double> simulated_seconds_per_second;
  std::optional<double> ns_per_tick;
  // Over the last second ("tail"); nullopt if the run ended before it.
  std::optional<double> tail_peak_to_peak_m;
  std::optional<double> tail_force_mean_n;
  std::optional<double> tail_force_std_n;
  // Sum of the forces over sum of the penetrations, of the tail's ticks in contact; nullopt without
  // one.
  std::optional<double> displayed_stiffness_n_per_m;
  // Of the judged pieces (touch_metrics.h); nullopt without one.
  std::optional<double> chatter_n;       // mean deviation of the force
  std::optional<double> swing_m;         // peak to peak of a sine with the position's deviation
  std::optional<double> shake_m_per_s2;  // mean deviation of the acceleration; simulator only
  // Over the whole run.
  double given_j = 0.0;           // energy that the walls gave to the hand
  std::optional<double> given_w;  // the same per second in contact; nullopt without a contact
  std::optional<double> max_penetration_m;  // nullopt without a contact
  double peak_force_n = 0.0;
  // Ticks with kFlagForceLimit.
  std::uint64_t saturated_ticks = 0;
  std::uint64_t contacts = 0;  // entries into the wall
  // The ledger after the last tick (core/tick/energy_ledger.h).
  double energy_cv_j = 0.0;
  double energy_hold_j = 0.0;
  double energy_scv_j = 0.0;
  double energy_budget_j = 0.0;
  // Minima over time, which are at most 0 because the sums start there.
  double min_energy_cv_j = 0.0;
  double min_energy_scv_j = 0.0;
  // Known to a simulator only; at the end of the last tick's hold.
  std::optional<double> true_actuator_work_j;
  std::optional<double> true_dissipation_j;
  std::optional<double> true_hand_work_j;
  std::optional<double> kinetic_j;
  // Hand work less the sum of kinetic change, dissipation and actuator work.
  std::optional<double> energy_balance_error_j;
  std::optional<double> energy_balance_relative;  // share of turnover_j(); nullopt if nothing moved
  // Minimum over time of the hand's net work, at most 0. Below 0 the hand has extracted energy.
  std::optional<double> passivity_margin_j;
  // Values of a session in real time, filled by its caller; all except the first and the last are
  // of a real device only.
  std::optional<std::uint64_t> missed_ticks;
  std::optional<std::uint64_t> missing_states;
  std::optional<std::uint64_t> void_reports;
  std::optional<std::uint64_t> applied_commands;
  std::optional<std::uint64_t> lost_commands;
  std::optional<std::uint64_t> rejected_commands;
  std::optional<double> delay_s;        // nullopt: unknown
  std::optional<double> disarmed_at_s;  // of the session's time; nullopt: it was not disarmed
  std::optional<std::string> disarm_reason;
  std::optional<std::uint64_t> lost_stream_samples;  // nullopt without --stream
  // Of a search for a hand that takes energy (core/study/worst_hand), filled by its caller.
  std::optional<std::uint64_t> searched_hands;  // nullopt without a search
  std::optional<double> most_taken_j;           // nullopt if no hand took energy
  std::optional<double> typical_taken_j;

  // False for a run that ended before its tail without diverging.
  [[nodiscard]] bool has_verdict() const {
    return verdict == Verdict::kDiverged || tail_peak_to_peak_m.has_value();
  }
};

// The axes of one run, x first. Precondition of its readers: not empty.
using RunSummary = std::vector<Summary>;

using SummaryMember =
    std::variant<std::string Summary::*, Verdict Summary::*, double Summary::*,
                 std::uint64_t Summary::*, std::optional<std::string> Summary::*,
                 std::optional<double> Summary::*, std::optional<std::uint64_t> Summary::*>;

// Summaries that have a key.
enum class KeyOf : std::uint8_t {
  kAll,
  kSession,  // of a session in real time
  kSearch,   // with a search for a hand that takes energy
};

struct SummaryKey {
  std::string_view name;  // in JSON, CSV, --expect and --sort
  SummaryMember member;
  bool of_run = false;  // all axes share it
  KeyOf of = KeyOf::kAll;
};

// True if this run has the keys of the group. Precondition: the summary is of axis x.
[[nodiscard]] constexpr bool has_keys(const Summary& run, KeyOf of) {
  if (of == KeyOf::kSession) return run.missed_ticks.has_value();
  return of == KeyOf::kAll || run.searched_hands.has_value();
}

inline constexpr std::string_view kLostStreamSamples = "lost_stream_samples";

// Keys in the order of JSON and CSV (docs/command-line.md). A new field needs a line here and one
// in summarise(); every output and every comparison of summaries reads this table.
inline constexpr std::array<SummaryKey, 48> kSummaryKeys{
    {{"scene", &Summary::scene, true},
     {"algorithm", &Summary::algorithm, true},
     {"verdict", &Summary::verdict},
     {"duration_s", &Summary::duration_s},
     {"ticks", &Summary::ticks},
     {"simulated_seconds_per_second", &Summary::simulated_seconds_per_second, true},
     {"ns_per_tick", &Summary::ns_per_tick, true},
     {"tail_peak_to_peak_m", &Summary::tail_peak_to_peak_m},
     {"tail_force_mean_n", &Summary::tail_force_mean_n},
     {"tail_force_std_n", &Summary::tail_force_std_n},
     {"displayed_stiffness_n_per_m", &Summary::displayed_stiffness_n_per_m},
     {"chatter_n", &Summary::chatter_n},
     {"swing_m", &Summary::swing_m},
     {"shake_m_per_s2", &Summary::shake_m_per_s2},
     {"given_j", &Summary::given_j},
     {"given_w", &Summary::given_w},
     {"max_penetration_m", &Summary::max_penetration_m},
     {"peak_force_n", &Summary::peak_force_n},
     {"saturated_ticks", &Summary::saturated_ticks},
     {"contacts", &Summary::contacts},
     {"energy_cv_j", &Summary::energy_cv_j},
     {"energy_hold_j", &Summary::energy_hold_j},
     {"energy_scv_j", &Summary::energy_scv_j},
     {"energy_budget_j", &Summary::energy_budget_j},
     {"min_energy_cv_j", &Summary::min_energy_cv_j},
     {"min_energy_scv_j", &Summary::min_energy_scv_j},
     {"true_actuator_work_j", &Summary::true_actuator_work_j},
     {"true_dissipation_j", &Summary::true_dissipation_j},
     {"true_hand_work_j", &Summary::true_hand_work_j},
     {"kinetic_j", &Summary::kinetic_j},
     {"energy_balance_error_j", &Summary::energy_balance_error_j},
     {"energy_balance_relative", &Summary::energy_balance_relative},
     {"passivity_margin_j", &Summary::passivity_margin_j},
     {"diverged_at_tick", &Summary::diverged_at_tick},
     {"verdict_note", &Summary::verdict_note, true},
     {"missed_ticks", &Summary::missed_ticks, true, KeyOf::kSession},
     {"missing_states", &Summary::missing_states, true, KeyOf::kSession},
     {"void_reports", &Summary::void_reports, true, KeyOf::kSession},
     {"applied_commands", &Summary::applied_commands, true, KeyOf::kSession},
     {"lost_commands", &Summary::lost_commands, true, KeyOf::kSession},
     {"rejected_commands", &Summary::rejected_commands, true, KeyOf::kSession},
     {"delay_s", &Summary::delay_s, true, KeyOf::kSession},
     {"disarmed_at_s", &Summary::disarmed_at_s, true, KeyOf::kSession},
     {"disarm_reason", &Summary::disarm_reason, true, KeyOf::kSession},
     {kLostStreamSamples, &Summary::lost_stream_samples, true, KeyOf::kSession},
     {"searched_hands", &Summary::searched_hands, true, KeyOf::kSearch},
     {"most_taken_j", &Summary::most_taken_j, true, KeyOf::kSearch},
     {"typical_taken_j", &Summary::typical_taken_j, true, KeyOf::kSearch}}};

}  // namespace hapticwall
