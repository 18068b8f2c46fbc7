// The four sums that the plots show, row by row (docs/physics.md, "The ledger").
#pragma once

#include "core/sample.h"

namespace hapticwall {

struct EnergyLedger {
  double cv_j = 0.0;      // Σ_{k≤n} F(k) Δx_k            [paper, Eq. 6]
  double hold_j = 0.0;    // Σ_{k≤n} (F(k-1) - F(k)) Δx_k  [paper, Eq. 9, 19]
  double scv_j = 0.0;     // Σ_{k<n} F(k) Δx_{k+1}         [paper, Eq. 10]
  double budget_j = 0.0;  // -T Σ_{k≤n} b v_k²             [paper, Eq. 16, 22]

  // Adds a row. Forces as really commanded; `budget_n_per_m` is b/T, because T b v² = (b/T) Δx².
  // Realtime-safe: yes.
  void add(double force_n, double previous_force_n, double displacement_m, double budget_n_per_m) {
    cv_j += force_n * displacement_m;
    hold_j += (previous_force_n - force_n) * displacement_m;
    scv_j += previous_force_n * displacement_m;
    budget_j -= budget_n_per_m * (displacement_m * displacement_m);
  }
};

// The row of a sample. Realtime-safe: yes.
[[nodiscard]] inline EnergyLedger ledger_of(const Sample& sample) {
  return {sample.energy_cv_j, sample.energy_hold_j, sample.energy_scv_j, sample.energy_budget_j};
}

}  // namespace hapticwall
