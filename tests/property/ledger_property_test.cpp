// Promises that hold in every scene, at every row.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/run/metrics.h"
#include "core/run/simulate.h"
#include "tests/position_bench.h"
#include "tests/property/scene_generator.h"
#include "tests/samples.h"
#include "tests/summary_support.h"

namespace hapticwall {
namespace {

using testing::any_algorithm;
using testing::flip;
using testing::random_scene;
using testing::set_parameter;

// Rows of a run, and how much energy went to and fro: the scale of its rounding.
struct Run {
  std::vector<Sample> rows;
  SimulationResult result;
  double turnover_j = 0.0;
};

Run run(const Scene& scene) {
  RC_ASSERT(!validate(scene).has_value());
  Run all;
  SimulationOptions options;
  options.on_sample = [&](const Sample& sample) { all.rows.push_back(sample); };
  all.result = simulate(scene, options);
  for (std::size_t i = 1; i < all.rows.size(); ++i) {
    const double step_m = std::abs(all.rows[i].position_m - all.rows[i - 1].position_m);
    all.turnover_j += step_m * (std::abs(all.rows[i].force_n) + std::abs(all.rows[i - 1].force_n));
    all.turnover_j += std::abs(all.rows[i].energy_budget_j - all.rows[i - 1].energy_budget_j);
  }
  return all;
}

constexpr double kLedgerRounding = 1e-12;

// The ledger again from the recorded columns alone.
RC_GTEST_PROP(Ledger, IsWhatTheColumnsSay, ()) {
  const Scene scene = random_scene(any_algorithm());
  const Run all = run(scene);
  double cv = 0.0;
  double hold = 0.0;
  double scv = 0.0;
  double squares = 0.0;
  for (std::size_t k = 0; k < all.rows.size(); ++k) {
    const double step_m = k == 0 ? 0.0 : all.rows[k].position_m - all.rows[k - 1].position_m;
    const double before_n = k == 0 ? 0.0 : all.rows[k - 1].force_n;
    cv += all.rows[k].force_n * step_m;
    hold += (before_n - all.rows[k].force_n) * step_m;
    scv += before_n * step_m;
    squares += std::pow(all.rows[k].velocity_m_per_s, 2);
    const double tolerance = kLedgerRounding * (all.turnover_j + 1e-15);
    RC_ASSERT(std::abs(all.rows[k].energy_cv_j - cv) <= tolerance);
    RC_ASSERT(std::abs(all.rows[k].energy_hold_j - hold) <= tolerance);
    RC_ASSERT(std::abs(all.rows[k].energy_scv_j - scv) <= tolerance);
    const double budget = -scene.sampling.period_s() * scene.x().device.damping_n_s_per_m * squares;
    RC_ASSERT(std::abs(all.rows[k].energy_budget_j - budget) <=
              kLedgerRounding * std::abs(budget) + 1e-18);
  }
}

RC_GTEST_PROP(Energy, BalanceClosesToABillionth, ()) {
  const Scene scene = random_scene(any_algorithm());
  const Run all = run(scene);
  const Summary& s = all.result.summary;
  const double scale = std::abs(*s.true_hand_work_j) + std::abs(*s.true_actuator_work_j) +
                       *s.true_dissipation_j + *s.kinetic_j;
  RC_ASSERT(std::abs(*s.energy_balance_error_j) <= 1e-9 * scale);
  if (scale > 0.0) {
    RC_ASSERT(*s.energy_balance_relative == std::abs(*s.energy_balance_error_j) / scale);
  }
}

// Without an encoder the ledger's Eq. 10 and the plant's own account are the same sum.
RC_GTEST_PROP(Energy, ScvIsTheTrueActuatorWorkWithoutAnEncoder, ()) {
  Scene scene = random_scene(any_algorithm());
  scene.x().device.encoder_m.reset();
  const Run all = run(scene);
  for (const Sample& row : all.rows) {
    RC_ASSERT(std::abs(row.energy_scv_j - row.truth.actuator_work_j) <=
              1e-10 * (all.turnover_j + 1e-12));
  }
}

RC_GTEST_PROP(None, ObserverIsNeverNegativeOnASpring, ()) {
  const Run all = run(random_scene("none"));
  for (const Sample& row : all.rows) {
    RC_ASSERT(row.energy_cv_j >= -kLedgerRounding * all.turnover_j);
  }
}

RC_GTEST_PROP(PassivityControl, WithTheSameSampleObserverIsNoneOnASpring, ()) {
  Scene scene = random_scene("passivity-control");
  const Run controlled = run(scene);
  scene.algorithm.index = find_algorithm("none").value();
  const Run bare = run(scene);
  RC_ASSERT(controlled.rows.size() == bare.rows.size());
  for (std::size_t k = 0; k < bare.rows.size(); ++k) {
    RC_ASSERT(controlled.rows[k].force_n == bare.rows[k].force_n);
    RC_ASSERT(controlled.rows[k].truth.position_m == bare.rows[k].truth.position_m);
  }
}

// b ≥ K T/2 + B [Eq. 18] holds for the coupling, so the hand never gets energy out of it, whatever
// the hand. (Without an encoder: the theory knows none.)
RC_GTEST_PROP(VirtualCoupling, IsPassive, ()) {
  Scene scene = random_scene("virtual-coupling");
  scene.x().device.encoder_m.reset();
  scene.x().device.friction_n.reset();
  const Run all = run(scene);
  RC_ASSERT(*all.result.summary.passivity_margin_j >= -kLedgerRounding * all.turnover_j);
}

RC_GTEST_PROP(Force, IsFiniteAndWithinTheLimitAtEveryRow, ()) {
  const Scene scene = random_scene(any_algorithm());
  const Run all = run(scene);
  RC_ASSERT(all.rows.size() == scene.tick_count() ||
            all.result.summary.verdict == Verdict::kDiverged);
  for (const Sample& row : all.rows) {
    RC_ASSERT(std::abs(row.force_n) <= *scene.x().device.force_limit_n);
  }
}

RC_GTEST_PROP(Simulate, TwiceIsTheSameToTheLastBit, ()) {
  const Scene scene = random_scene(any_algorithm());
  const Run first = run(scene);
  const Run second = run(scene);
  RC_ASSERT(first.rows.size() == second.rows.size());
  for (std::size_t k = 0; k < first.rows.size(); ++k) {
    RC_ASSERT(first.rows[k].truth.position_m == second.rows[k].truth.position_m);
    RC_ASSERT(first.rows[k].truth.velocity_m_per_s == second.rows[k].truth.velocity_m_per_s);
    RC_ASSERT(first.rows[k].truth.hand_work_j == second.rows[k].truth.hand_work_j);
    RC_ASSERT(first.rows[k].truth.dissipation_j == second.rows[k].truth.dissipation_j);
    RC_ASSERT(first.rows[k].force_n == second.rows[k].force_n);
  }
}

// The summary of a run equals the summary of its samples, except for the plant's energies: those
// are taken after the last hold, which no sample sees.
RC_GTEST_PROP(Simulate, SummaryIsThatOfItsSamples, ()) {
  Scene scene = random_scene(any_algorithm());
  set_parameter(scene.algorithm, "then", flip() ? 1.0 : 0.0);
  const Run all = run(scene);
  RC_PRE(all.result.summary.verdict != Verdict::kDiverged);  // its last tick has no sample
  Metrics metrics(scene, scene.tick_count(), SampleOrigin::kSimulator);
  for (const Sample& row : all.rows) metrics.add(row);
  Summary from_samples = metrics.finish();
  for (const auto energy :
       {&Summary::true_actuator_work_j, &Summary::true_dissipation_j, &Summary::true_hand_work_j,
        &Summary::kinetic_j, &Summary::energy_balance_error_j, &Summary::energy_balance_relative,
        &Summary::passivity_margin_j}) {
    from_samples.*energy = all.result.summary.*energy;
  }
  RC_ASSERT(testing::differences(from_samples, all.result.summary) == "");
}

// Two runs that differ in the hand's script only after tick k agree up to tick k.
RC_GTEST_PROP(Simulate, KnowsNothingOfTheFuture, ()) {
  Scene scene = random_scene(any_algorithm());
  scene.x().hand->path.edit().resize(1);
  scene.x().hand->path.edit().push_back({0.5, 0.055});
  const Run first = run(scene);
  scene.x().hand->path.edit().push_back({0.6, 0.03});
  const Run second = run(scene);
  const std::size_t same = std::min({static_cast<std::size_t>(0.5 * scene.sampling.rate_hz),
                                     first.rows.size(), second.rows.size()});
  for (std::size_t k = 0; k < same; ++k) {
    RC_ASSERT(first.rows[k].truth.position_m == second.rows[k].truth.position_m);
  }
}

// A change at a tick splits the run: before it nothing differs, and the force does not jump at it.
RC_GTEST_PROP(ScheduledChange, TakesEffectAtItsTickWithoutAKick, ()) {
  const Scene scene = random_scene(any_algorithm());
  ScheduledChange change;
  change.tick = *rc::gen::inRange<std::uint64_t>(1, scene.tick_count() - 1);
  change.scene = scene;
  change.scene.algorithm.index = find_algorithm(any_algorithm()).value();
  RC_PRE(change.scene.algorithm.index != scene.algorithm.index);
  const Run plain = run(scene);
  const std::vector<Sample> changed = testing::samples_of(scene, {&change, 1});
  RC_PRE(changed.size() > change.tick);  // a run may diverge before
  for (std::size_t k = 0; k < change.tick; ++k) {
    RC_ASSERT(changed[k].force_n == plain.rows[k].force_n);
  }
  RC_ASSERT((changed[change.tick].flags & kFlagParametersChanged) != 0U);
  RC_ASSERT(std::abs(changed[change.tick].force_n - changed[change.tick - 1].force_n) <= 1e-9);
}

}  // namespace
}  // namespace hapticwall
