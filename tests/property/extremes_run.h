// A run of an extreme scene and what must hold in every one of them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "core/run/simulate.h"
#include "tests/energy_turnover.h"
#include "tests/property/extremes_scene.h"

namespace hapticwall::testing {

// True if every number that the summary has is finite, and it has the plant's energies.
inline bool is_finite(const Summary& summary) {
  const bool finite = std::ranges::all_of(kSummaryKeys, [&](const SummaryKey& key) {
    const auto* always = std::get_if<double Summary::*>(&key.member);
    const auto* maybe = std::get_if<std::optional<double> Summary::*>(&key.member);
    return (always == nullptr || std::isfinite(summary.**always)) &&
           (maybe == nullptr || std::isfinite((summary.**maybe).value_or(0.0)));
  });
  return finite && summary.passivity_margin_j && summary.energy_balance_error_j;
}

inline constexpr double kPromisedBalance = 1e-9;
// Below this an energy has no digits left: it is a product of numbers near the smallest.
inline constexpr double kMinEnergyJ = 1e-300;

// Max error of the balance, relative to the turnover: 1e-9, except if a damper stops its mass in a
// small fraction 1/S of a tick. The energy that flows in that fraction is the difference of sums
// over the whole tick: one body's balance keeps eps S, and that of a gripped handle, whose two
// bodies' states cancel each other in a quadratic form, eps S². So 1e-9 is promised up to S = 4.5e6
// for one body and 2.1e3 for a grip; the paper's device has S = 0.02.
inline double promised_balance(const Scene& scene) {
  const double s = fastest_decay_per_s(scene) * scene.sampling.period_s();
  const bool grip = scene.x().hand && scene.x().hand->has_grip();
  const double loss = std::numeric_limits<double>::epsilon() * (grip ? s * s : s);
  return std::max(kPromisedBalance, loss);
}

struct ExtremeRun {
  SimulationResult result;
  std::vector<double> commands_n;
  Turnover turnover;
  bool finite = true;
  bool within_limit = true;
  bool in_order = true;
};

inline ExtremeRun run_watched(const Scene& scene, std::span<const ScheduledChange> changes = {}) {
  ExtremeRun run;
  const double limit_n =
      scene.x().device.force_limit_n.value_or(std::numeric_limits<double>::max());
  SimulationOptions options;
  options.changes = changes;
  options.on_sample = [&](const Sample& sample) {
    run.in_order = run.in_order && sample.tick == run.commands_n.size();
    run.finite = run.finite && is_finite(sample);
    run.within_limit = run.within_limit && std::abs(sample.force_n) <= limit_n;
    run.commands_n.push_back(sample.force_n);
    run.turnover.add(sample.truth);
  };
  run.result = simulate(scene, options);
  run.turnover.add(run.result.final_state.truth);
  run.finite = run.finite && is_finite(run.result.final_state) && is_finite(run.result.summary);
  return run;
}

// A run ends at its last tick, or as diverged at the tick that it tells.
inline bool ended_in_good_order(const Scene& scene, const ExtremeRun& run) {
  const Summary& summary = run.result.summary;
  const bool diverged = summary.verdict == Verdict::kDiverged;
  if (diverged != summary.diverged_at_tick.has_value() || run.result.stopped_early) return false;
  const bool in_reach = std::abs(run.result.final_state.truth.position_m) <= kDivergedPositionM;
  if (!diverged && !in_reach) return false;
  const std::uint64_t told = diverged ? *summary.diverged_at_tick : scene.tick_count();
  // A force that is not finite ends the run in the tick that asks for it.
  return run.in_order && run.commands_n.size() == told && told <= scene.tick_count() &&
         summary.ticks >= told && summary.ticks <= told + 1;
}

// How far the balance is off, relative to the turnover; the costly measure of that is taken only
// where the cheap one does not do.
inline double balance_error(const Scene& scene, const ExtremeRun& run) {
  const double error_j =
      std::max(0.0, std::abs(*run.result.summary.energy_balance_error_j) - kMinEnergyJ);
  if (error_j <= kPromisedBalance * run.turnover.joules()) {
    return error_j > 0.0 ? error_j / run.turnover.joules() : 0.0;
  }
  return error_j / std::max(run.turnover.joules(), turnover_within_ticks(scene, run.commands_n));
}

inline std::string scene_text(const Scene& scene) {
  std::ostringstream out;
  const DeviceSettings& d = scene.x().device;
  constexpr int kDigits = 17;
  out.precision(kDigits);
  out << "rate " << scene.sampling.rate_hz << " ticks " << scene.tick_count() << " m " << d.mass_kg
      << " b " << d.damping_n_s_per_m << " f_c " << d.friction_n.value_or(0.0) << " encoder "
      << d.encoder_m.value_or(0.0) << " limit " << d.force_limit_n.value_or(-1.0) << " resolution "
      << d.force_resolution_n.value_or(0.0) << " delay " << d.delay_ticks.value_or(0) << " lag "
      << d.amplifier_time_constant_s.value_or(0.0) << " start " << d.start_m << ' '
      << algorithms()[scene.algorithm.index].name << ' ' << scene.simulator.integrator_name() << '/'
      << scene.simulator.substeps;
  for (const WallSettings& wall : scene.x().walls) {
    out << "; wall " << wall.position_m << " K " << wall.stiffness_n_per_m << " B "
        << wall.damping_n_s_per_m;
  }
  if (!scene.x().hand) return out.str();
  const HandSettings& h = *scene.x().hand;
  out << "; hand m " << h.mass_kg.value_or(0.0) << " k " << h.stiffness_n_per_m << " b "
      << h.damping_n_s_per_m << " grip " << h.grip_stiffness_n_per_m.value_or(-1.0) << ' '
      << h.grip_damping_n_s_per_m.value_or(0.0) << " path";
  for (const PathPoint& point : h.path)
    out << " (" << point.time_s << ", " << point.position_m << ')';
  return out.str();
}

// All of it; tells the balance's error.
inline double expect_sound(const Scene& scene) {
  const auto problem = validate(scene);
  EXPECT_FALSE(problem.has_value()) << problem->key << ": " << problem->message;
  if (problem) return 0.0;
  const ExtremeRun run = run_watched(scene);
  EXPECT_TRUE(run.finite) << scene_text(scene);
  EXPECT_TRUE(run.within_limit) << scene_text(scene);
  EXPECT_TRUE(ended_in_good_order(scene, run)) << scene_text(scene);
  if (scene.simulator.integrator != Integrator::kExact) return 0.0;
  const double error = balance_error(scene, run);
  EXPECT_LE(error, promised_balance(scene)) << scene_text(scene);
  return error;
}

}  // namespace hapticwall::testing
