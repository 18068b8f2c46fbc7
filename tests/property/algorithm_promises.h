// The promises of the algorithms' formulas, checked on the rows of a run. Every function fails its
// property if a promise is broken.
#pragma once

#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/sample.h"
#include "core/tick/servo.h"

namespace hapticwall::testing {

// Relative error of sums.
inline constexpr double kRounding = 1e-12;

// The settings and the rows of a run that no parameter changed.
struct Trial {
  ServoSettings settings;
  std::vector<Sample> rows;

  [[nodiscard]] double b() const { return believed_damping(algorithm_context(settings)); }
  [[nodiscard]] double per_period() const { return b() * settings.rate_hz; }  // b/T
};

// A row beside the one before it, and how much energy went to and fro up to here.
struct Step {
  const Sample& now;
  double moved_m;
  double before_n;
  double turnover_j;
};

template <typename Check>
void for_each_step(const Trial& trial, Check&& check) {
  double turnover_j = 0.0;
  for (std::size_t k = 0; k < trial.rows.size(); ++k) {
    const Sample& now = trial.rows[k];
    const double moved_m = k == 0 ? 0.0 : now.position_m - trial.rows[k - 1].position_m;
    const double before_n = k == 0 ? 0.0 : trial.rows[k - 1].force_n;
    turnover_j += std::abs(moved_m) * (std::abs(now.force_n) + std::abs(before_n)) +
                  trial.per_period() * moved_m * moved_m;
    check(Step{now, moved_m, before_n, turnover_j});
  }
}

inline void forces_are_finite_and_within_the_limit(const Trial& trial) {
  for (const Sample& row : trial.rows) {
    RC_ASSERT(std::isfinite(row.force_n));
    RC_ASSERT(std::abs(row.force_n) <= trial.settings.force_limit_n);
  }
}

// |F(k) - F(k-1)| ≤ b|v|, at rest ≤ α_max; so energy_hold ≥ energy_budget, but for 1e-15 J per
// newton that the force changes at rest.
inline void energy_bounding_keeps_its_bound(const Trial& trial) {
  const double hidden_n =
      trial.settings.encoder_m > 0.0 ? trial.b() * 0.0075 : std::numeric_limits<double>::max();
  const double rest_n = algorithm_context(trial.settings).value_or("rest_force_step_n", hidden_n);
  constexpr double kMaxRestM = 1e-15;
  double at_rest_j = 0.0;
  for_each_step(trial, [&](const Step& step) {
    const double changed_n = std::abs(step.now.force_n - step.before_n);
    const bool moves = std::abs(step.moved_m) > kMaxRestM;
    const double bound_n = moves ? trial.b() * std::abs(step.now.velocity_m_per_s) : rest_n;
    const double scale_n = std::abs(step.now.force_n) + std::abs(step.before_n);
    if (!moves) at_rest_j += kMaxRestM * changed_n;
    RC_ASSERT(changed_n <= bound_n + kRounding * scale_n);
    RC_ASSERT(step.now.energy_hold_j >=
              step.now.energy_budget_j - at_rest_j - kRounding * step.turnover_j);
  });
}

// |β| ≤ c₁, held at rest, F Δx ≥ (F(k)² - F(k-1)²)/(2c₂); so energy_hold ≥ energy_budget and
// energy_cv ≥ F²/(2c₂) ≥ 0.
inline void energy_bounding_2010_keeps_its_bounds(const Trial& trial) {
  const double c1 = trial.per_period();
  const double c2 = algorithm_context(trial.settings).value_or("storage_stiffness_n_per_m", c1);
  for_each_step(trial, [&](const Step& step) {
    const double force_n = step.now.force_n;
    const double scale_n =
        std::abs(force_n) + std::abs(step.before_n) + c1 * std::abs(step.moved_m);
    RC_ASSERT(std::abs(force_n - step.before_n) <=
              c1 * std::abs(step.moved_m) + kRounding * scale_n);
    const double stored = force_n * force_n - step.before_n * step.before_n;  // times 2c₂
    RC_ASSERT(2.0 * c2 * force_n * step.moved_m >= stored - kRounding * scale_n * scale_n);
    RC_ASSERT(step.now.energy_hold_j >= step.now.energy_budget_j - kRounding * step.turnover_j);
    RC_ASSERT(step.now.energy_cv_j >= -kRounding * step.turnover_j);
  });
}

// E - F² T/(4b) ≥ 0 at every row, with E from the rows alone; so energy_scv ≥ energy_budget.
inline void force_bounding_never_owes(const Trial& trial) {
  const double c = trial.per_period();
  double e_j = 0.0;
  for_each_step(trial, [&](const Step& step) {
    if (step.before_n == 0.0) e_j = 0.0;
    e_j += c * step.moved_m * step.moved_m + step.before_n * step.moved_m;
    RC_ASSERT(e_j >= -kRounding * step.turnover_j);
    RC_ASSERT(4.0 * c * e_j - step.now.force_n * step.now.force_n >=
              -kRounding * 4.0 * c * step.turnover_j);
    RC_ASSERT(step.now.energy_scv_j >= step.now.energy_budget_j - kRounding * step.turnover_j);
    RC_ASSERT(std::abs(step.now.force_n) <= std::abs(step.now.wall_force_n));
  });
}

// The wall's force half a tick ahead, to the last bit.
inline void half_sample_is_half_a_tick_ahead(const Trial& trial) {
  for_each_step(trial, [&](const Step& step) {
    const double ahead_m = step.now.position_m + step.moved_m / 2.0;
    double sum_n = 0.0;
    for (const WallSettings& wall : trial.settings.walls.walls()) {
      const double p = ahead_m - wall.position_m;
      if (p <= 0.0) continue;
      sum_n += std::max(
          0.0, wall.stiffness_n_per_m * p + wall.damping_n_s_per_m * step.now.velocity_m_per_s);
    }
    RC_ASSERT(step.now.force_n == std::min(sum_n, trial.settings.force_limit_n));
  });
}

// One wall without damping, no force limit: F within its bounds, and the book never below its
// floor H ≥ -(b/T) Σ Δx² - (max(κ, K/2) + κ/2) P², κ = 2b/T, sums and P since the contact began.
inline void energy_limited_spring_keeps_its_floor(const Trial& trial) {
  const double stiffness = trial.settings.walls.walls().front().stiffness_n_per_m;
  const double passive = 2.0 * trial.per_period();
  const double depth_cost = std::max(passive, stiffness / 2.0) + passive / 2.0;
  double h_j = 0.0;
  double eaten_j = 0.0;
  double deepest_m = 0.0;
  bool inside = false;
  for_each_step(trial, [&](const Step& step) {
    const bool was_inside = inside;
    inside = (step.now.flags & kFlagInContact) != 0;
    if (!inside || !was_inside) h_j = eaten_j = deepest_m = 0.0;
    if (!inside) return;
    const double p = step.now.penetration_m;
    h_j += step.before_n * step.moved_m;
    if (was_inside) eaten_j += trial.per_period() * step.moved_m * step.moved_m;
    deepest_m = std::max(deepest_m, p);
    const double slack_j = kRounding * step.turnover_j;
    RC_ASSERT(h_j >= -eaten_j - depth_cost * deepest_m * deepest_m - slack_j);
    const double spring_n = std::sqrt(2.0 * stiffness * (std::max(h_j, 0.0) + slack_j));
    RC_ASSERT(step.now.force_n <= std::max(passive * p, spring_n) * (1.0 + kRounding));
    RC_ASSERT(step.now.force_n <= step.now.wall_force_n);
    RC_ASSERT(step.now.force_n >= std::min(step.now.wall_force_n, passive * p) * (1.0 - kRounding));
  });
}

// Holds without a limit, a floor and a reset: if the observer is below the tolerated energy, the
// damper is at its cap. The observer is that of Eq. 6; `one_step`: that of Eq. 10 a tick later, if
// the handle then moves as in the last tick. `wanted_n`: the force that the controller acts on, row
// by row.
inline void passivity_control_acts_or_is_capped(const Trial& trial, double cap, bool credit,
                                                bool one_step,
                                                const std::vector<double>& wanted_n) {
  std::size_t k = 0;
  for_each_step(trial, [&](const Step& step) {
    const double damper_n = step.now.force_n - wanted_n[k++];
    const double most_n = cap * std::abs(step.now.velocity_m_per_s);
    const double scale_n = std::abs(step.now.force_n) + most_n;
    RC_ASSERT(std::abs(damper_n) <= most_n + kRounding * scale_n);
    RC_ASSERT(damper_n * step.now.velocity_m_per_s >= 0.0);
    const double tolerated_j = credit ? step.now.energy_budget_j : 0.0;
    if (step.moved_m != 0.0 && std::abs(damper_n) < most_n - kRounding * scale_n) {
      const double next_j = step.now.energy_scv_j + step.now.force_n * step.moved_m;
      const double observed_j = one_step ? next_j : step.now.energy_cv_j;
      RC_ASSERT(observed_j >= tolerated_j - kRounding * step.turnover_j);
    }
  });
}

// The held-force observer of Eq. 10 without limit, credit and reset, and a damper with a velocity
// floor.
inline void passivity_control_acts_above(const Trial& trial, double floor_m_per_s) {
  double observed_j = 0.0;
  for_each_step(trial, [&](const Step& step) {
    observed_j += step.before_n * step.moved_m;
    const double v = step.now.velocity_m_per_s;
    if (std::abs(v) <= floor_m_per_s) {
      RC_ASSERT(step.now.force_n == step.now.wall_force_n);
    } else if (observed_j < -kRounding * step.turnover_j) {
      RC_ASSERT((step.now.force_n - step.now.wall_force_n) * v > 0.0);
    }
  });
}

}  // namespace hapticwall::testing
