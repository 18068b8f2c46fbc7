// What the tests of the batch share: figures compared to the last bit, and every instruction set
// of this processor.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/batch/batch_simulator.h"
#include "core/batch/lane_targets.h"
#include "core/simulate.h"
#include "core/summary.h"

namespace hapticwall::testing {

// Runs the lanes with one instruction set only, as long as it lives.
class OnlyTarget {
 public:
  explicit OnlyTarget(std::int64_t target) { hwy::SetSupportedTargetsForTest(target); }
  ~OnlyTarget() { hwy::SetSupportedTargetsForTest(0); }
  OnlyTarget(const OnlyTarget&) = delete;
  OnlyTarget& operator=(const OnlyTarget&) = delete;
};

inline std::vector<std::int64_t> lane_targets() { return hwy::SupportedAndGeneratedTargets(); }

// Names of the figures that differ; empty where all are the same to the last bit.
inline std::string differences(const Summary& a, const Summary& b) {
  std::string names;
  const auto compare = [&](const char* name, const auto& x, const auto& y) {
    if (!(x == y)) names += std::string(name) + " ";
  };
  compare("scene", a.scene, b.scene);
  compare("algorithm", a.algorithm, b.algorithm);
  compare("verdict", a.verdict, b.verdict);
  compare("duration_s", a.duration_s, b.duration_s);
  compare("ticks", a.ticks, b.ticks);
  compare("diverged_at_tick", a.diverged_at_tick, b.diverged_at_tick);
  compare("tail_peak_to_peak_m", a.tail_peak_to_peak_m, b.tail_peak_to_peak_m);
  compare("tail_force_mean_n", a.tail_force_mean_n, b.tail_force_mean_n);
  compare("tail_force_std_n", a.tail_force_std_n, b.tail_force_std_n);
  compare("displayed_stiffness", a.displayed_stiffness_n_per_m, b.displayed_stiffness_n_per_m);
  compare("max_penetration_m", a.max_penetration_m, b.max_penetration_m);
  compare("peak_force_n", a.peak_force_n, b.peak_force_n);
  compare("saturated_ticks", a.saturated_ticks, b.saturated_ticks);
  compare("contacts", a.contacts, b.contacts);
  compare("energy_cv_j", a.energy_cv_j, b.energy_cv_j);
  compare("energy_hold_j", a.energy_hold_j, b.energy_hold_j);
  compare("energy_scv_j", a.energy_scv_j, b.energy_scv_j);
  compare("energy_budget_j", a.energy_budget_j, b.energy_budget_j);
  compare("min_energy_cv_j", a.min_energy_cv_j, b.min_energy_cv_j);
  compare("min_energy_scv_j", a.min_energy_scv_j, b.min_energy_scv_j);
  compare("true_actuator_work_j", a.true_actuator_work_j, b.true_actuator_work_j);
  compare("true_dissipation_j", a.true_dissipation_j, b.true_dissipation_j);
  compare("true_hand_work_j", a.true_hand_work_j, b.true_hand_work_j);
  compare("kinetic_j", a.kinetic_j, b.kinetic_j);
  compare("energy_balance_error_j", a.energy_balance_error_j, b.energy_balance_error_j);
  compare("passivity_margin_j", a.passivity_margin_j, b.passivity_margin_j);
  return names;
}

inline std::string differences(const BatchVerdict& a, const Summary& b) {
  const BatchVerdict of_summary{b.verdict, b.ticks, b.diverged_at_tick, b.tail_peak_to_peak_m,
                                b.max_penetration_m};
  return a == of_summary ? "" : "verdict";
}

// simulate(), one by one.
inline std::vector<Summary> one_by_one(const std::vector<Scene>& scenes) {
  std::vector<Summary> all;
  for (const Scene& scene : scenes) all.push_back(simulate(scene).summary);
  return all;
}

// The first scene whose figures differ from simulate()'s, in words; empty where none does.
template <typename Figures>
std::string first_difference(const BatchResult<Figures>& batch,
                             const std::vector<Summary>& wanted) {
  if (batch.figures.size() != wanted.size()) return "number of scenes";
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!batch.figures[i]) return "scene " + std::to_string(i) + " has no figures";
    const std::string names = differences(*batch.figures[i], wanted[i]);
    if (!names.empty()) return "scene " + std::to_string(i) + ": " + names;
  }
  return "";
}

}  // namespace hapticwall::testing
