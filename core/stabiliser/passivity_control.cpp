#include "core/stabiliser/passivity_control.h"

#include <algorithm>
#include <cmath>

namespace hapticwall {

void PassivityControl::configure(const StabiliserContext& context) {
  period_s_ = context.period_s;
  damping_n_s_per_m_ = believed_damping(context);
  held_force_ = context.value_or("observer", 0.0) != 0.0;
  damping_credit_ = context.value_or("damping_credit", 0.0) != 0.0;
  reset_in_free_motion_ = context.value_or("reset_in_free_motion", 0.0) != 0.0;
  max_damping_n_s_per_m_ = max_damping(context);
  velocity_floor_m_per_s_ = context.value_or("velocity_floor_m_per_s", 0.0);
}

void PassivityControl::reset() {
  observed_j_ = 0.0;
  credit_j_ = 0.0;
  pending_displacement_m_ = 0.0;
}

double PassivityControl::step(const StabiliserInput& input) {
  // The force really applied is known one tick later: both pairings take it from there.
  observed_j_ +=
      input.previous_force_n * (held_force_ ? input.displacement_m : pending_displacement_m_);
  pending_displacement_m_ = input.displacement_m;
  if (damping_credit_) {
    credit_j_ += damping_n_s_per_m_ * std::abs(input.velocity_m_per_s * input.displacement_m);
  }
  if (reset_in_free_motion_ && !input.in_contact) {
    observed_j_ = 0.0;
    credit_j_ = 0.0;
    pending_displacement_m_ = 0.0;
  }
  const double energy_j =
      held_force_ ? observed_j_ : observed_j_ + input.wall_force_n * input.displacement_m;
  const double deficit_j = -credit_j_ - energy_j;
  if (!(deficit_j > 0.0) || !(std::abs(input.velocity_m_per_s) > velocity_floor_m_per_s_)) {
    return input.wall_force_n;
  }
  return input.wall_force_n + damping_force(input, deficit_j);
}

double PassivityControl::damping_force(const StabiliserInput& input, double deficit_j) const {
  // α T v² is what a damper α takes in a tick; T v = Δx.
  const double energy_at_cap_j =
      max_damping_n_s_per_m_ * std::abs(input.velocity_m_per_s * input.displacement_m);
  if (deficit_j >= energy_at_cap_j) return max_damping_n_s_per_m_ * input.velocity_m_per_s;
  return deficit_j / input.displacement_m;
}

}  // namespace hapticwall
