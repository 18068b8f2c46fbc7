#include "core/study/identify/handle_model.h"

#include <cmath>

namespace hapticwall::identify {
namespace {

// A shorter lag counts as none.
constexpr double kMinLagS = 1e-7;

double command(const std::vector<double>& force_n, std::size_t tick, std::size_t delay) {
  return tick >= delay ? force_n[tick - delay] : 0.0;
}

template <typename Plant>
void start_at(Plant& plant, SegmentStart start, double actuator_n) {
  plant.reset();
  auto motion = plant.motion();
  motion.body.position_m = start.position_m;
  motion.body.velocity_m_per_s = start.velocity_m_per_s;
  motion.direction = (start.velocity_m_per_s > 0.0) - (start.velocity_m_per_s < 0.0);
  if constexpr (requires { motion.body.actuator_n; }) motion.body.actuator_n = actuator_n;
  plant.resume(motion);
}

}  // namespace

HandleModel::HandleModel(const Parameters& parameters, double period_s)
    : bias_n_((parameters[kFrictionUp] - parameters[kFrictionDown]) / 2.0),
      held_share_(parameters[kLag] > kMinLagS ? std::exp(-period_s / parameters[kLag]) : 0.0),
      plant_(plant(parameters, period_s)) {}

auto HandleModel::plant(const Parameters& parameters, double period_s)
    -> std::variant<Quick, Lagging> {
  PlantParameters numbers;
  numbers.mass_kg = std::exp(parameters[kLogMass]);
  numbers.damping_n_s_per_m = parameters[kDamping];
  numbers.friction_n = (parameters[kFrictionUp] + parameters[kFrictionDown]) / 2.0;
  numbers.time_constant_s = parameters[kLag];
  const HandPath path(0.0, 1.0 / period_s);
  if (parameters[kLag] > kMinLagS) {
    return Lagging({numbers, period_s}, path, period_s, 0.0, numbers.friction_n);
  }
  return Quick({numbers, period_s}, path, period_s, 0.0, numbers.friction_n);
}

std::vector<double> HandleModel::actuator(std::span<const double> force_n,
                                          std::size_t delay) const {
  std::vector<double> actuator_n(force_n.size() + delay, 0.0);
  for (std::size_t i = delay + 1; i < actuator_n.size(); ++i) {
    const double told_n = force_n[i - 1 - delay];
    actuator_n[i] = told_n + held_share_ * (actuator_n[i - 1] - told_n);
  }
  return actuator_n;
}

void HandleModel::run(const Segment& segment, SegmentStart start,
                      const std::vector<double>& force_n, std::size_t delay,
                      const std::vector<double>& actuator_n, std::vector<double>& position_m) {
  position_m.resize(segment.count);
  std::visit(
      [&](auto& plant) {
        start_at(plant, start, actuator_n[segment.first] + bias_n_);
        auto motion = plant.motion();
        for (std::size_t i = 0; i < segment.count; ++i) {
          position_m[i] = motion.body.position_m;
          const double force = command(force_n, segment.first + i, delay) + bias_n_;
          if (plant.try_tick(motion, force)) continue;
          plant.resume(motion);
          plant.advance(force);
          motion = plant.motion();
        }
      },
      plant_);
}

}  // namespace hapticwall::identify
