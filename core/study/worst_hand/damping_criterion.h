// The damping that a linear loop needs so that no hand takes energy from it, without a search.
#pragma once

#include <optional>

#include "core/scene.h"

namespace hapticwall::worst_hand {

// A spring between handle and ground, N/m.
struct SpringRange {
  double from_n_per_m = 0.0;
  // nullopt: up to the stiffest one whose motion the loop resolves, at half its rate.
  std::optional<double> to_n_per_m;
};

struct DampingCriterion {
  // b_CS = max over θ of T Re{(1 - e^(-jθ)) H(e^(jθ))} / (2 (1 - cos θ)); H is the transfer
  // function from position to force. A device with more damping gives no hand energy, one with less
  // gives it to some hand. Source: Colgate & Schenkel, "Passivity of a class of sampled-data
  // systems", 1997.
  double needed_n_s_per_m = 0.0;
  // The softest springs with which the loop is unstable, by eigenvalues. nullopt: there are none.
  // A loop with too little damping may have none: another hand then shows it.
  std::optional<SpringRange> unstable_springs;
  // Mass of handle and hand in all, kg: the loop is unstable with each larger one up to 100 kg, by
  // its eigenvalues. 0: it is so with every mass. nullopt: 100 kg are stable.
  std::optional<double> critical_mass_kg;
};

// The criterion of axis x, while the handle stays in its wall. nullopt unless the loop is linear:
// `none`, `virtual-coupling` or `half-sample` without a follower, one wall, the backward
// difference, and no friction, encoder, force resolution or amplifier's lag. Realtime-safe: no.
[[nodiscard]] std::optional<DampingCriterion> damping_criterion(const Scene& scene);

}  // namespace hapticwall::worst_hand
