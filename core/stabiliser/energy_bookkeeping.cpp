#include "core/stabiliser/energy_bookkeeping.h"

#include <algorithm>
#include <cmath>

namespace hapticwall {

void EnergyBookkeeping::configure(const StabiliserContext& context) {
  walls_ = context.walls;
  passive_n_per_m_ = passive_stiffness(context);
}

double EnergyBookkeeping::step(const StabiliserInput& input) {
  energy_j_ = input.in_contact ? energy_j_ + input.previous_force_n * input.displacement_m : 0.0;
  const double allowed_n =
      std::max(passive_n_per_m_ * input.penetration_m, spring_force(std::max(energy_j_, 0.0)));
  return std::min(input.wall_force_n, allowed_n);
}

double EnergyBookkeeping::spring_force(double energy_j) const {
  const auto walls = walls_.walls();
  double force_n = 0.0;
  double stiffness_n_per_m = 0.0;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    stiffness_n_per_m += walls[i].stiffness_n_per_m;
    if (i + 1 == walls.size()) break;
    // Where the next wall is met, the force is this, and so much is stored on the way.
    const double gap_m = walls[i + 1].position_m - walls[i].position_m;
    const double next_n = force_n + stiffness_n_per_m * gap_m;
    const double gap_j = 0.5 * (force_n + next_n) * gap_m;
    if (!(energy_j > gap_j)) break;
    energy_j -= gap_j;
    force_n = next_n;
  }
  return std::sqrt(force_n * force_n + 2.0 * stiffness_n_per_m * energy_j);
}

}  // namespace hapticwall
