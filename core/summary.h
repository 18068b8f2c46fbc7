// What a run comes to. What does not apply is an absent optional.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapticwall {

enum class Verdict : std::uint8_t { kSettled, kOscillating, kDiverged };

[[nodiscard]] constexpr std::string_view verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kSettled:
      return "settled";
    case Verdict::kOscillating:
      return "oscillating";
    case Verdict::kDiverged:
      break;
  }
  return "diverged";
}

struct Summary {
  std::string scene;
  std::string algorithm;
  Verdict verdict = Verdict::kSettled;
  double duration_s = 0.0;  // simulated
  std::uint64_t ticks = 0;
  std::optional<std::uint64_t> diverged_at_tick;
  // Wall-clock figures, filled by whoever holds a clock.
  std::optional<double> simulated_seconds_per_second;
  std::optional<double> ns_per_tick;
  // Over the last second ("tail"); absent where the run ended before it.
  std::optional<double> tail_peak_to_peak_m;
  std::optional<double> tail_force_mean_n;
  std::optional<double> tail_force_std_n;
  std::optional<double> displayed_stiffness_n_per_m;  // absent where the tail has no contact
  // Over the whole run.
  std::optional<double> max_penetration_m;  // absent without a wall or a tick
  double peak_force_n = 0.0;
  std::uint64_t saturated_ticks = 0;
  std::uint64_t contacts = 0;  // entries into the wall
  double energy_cv_j = 0.0;
  double energy_hold_j = 0.0;
  double energy_scv_j = 0.0;
  double energy_budget_j = 0.0;
  double min_energy_cv_j = 0.0;
  double min_energy_scv_j = 0.0;
  // Only a simulator knows these; at the end of the last tick's hold.
  std::optional<double> true_actuator_work_j;
  std::optional<double> true_dissipation_j;
  std::optional<double> true_hand_work_j;
  std::optional<double> kinetic_j;
  std::optional<double> energy_balance_error_j;
  std::optional<double> passivity_margin_j;
  // Of a corner: the summary of axis y alone; the rest is that of axis x.
  std::vector<Summary> y;
};

}  // namespace hapticwall
