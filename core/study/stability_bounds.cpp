#include "core/study/stability_bounds.h"

#include <algorithm>

#include "core/algorithm/algorithm.h"
#include "core/estimator/estimator.h"
#include "core/plant/plant_model.h"
#include "core/study/mean_square_stiffness.h"
#include "core/study/stable_stiffness.h"

namespace hapticwall {
namespace {

EstimatorContext estimator_context(const Scene& scene) {
  return {scene.sampling.render_rate_hz(), scene.x().device.encoder_m.value_or(0.0),
          &scene.estimator};
}

}  // namespace

StabilityBounds stability_bounds(const Scene& scene, const WallSettings& wall,
                                 const LoopDelay& delay) {
  const DeviceSettings& device = scene.x().device;
  const double render_period_s = 1.0 / scene.sampling.render_rate_hz();
  const double half_period_s = 0.5 * render_period_s;
  const double damping = device.damping_n_s_per_m;
  const double wall_damping = wall.damping_n_s_per_m;
  const auto velocity = velocity_transfer(estimator_context(scene));
  const bool difference = velocity && velocity->is_difference();
  const bool regular = !scene.sampling.at_random();
  StabilityBounds bounds;
  if (regular && (difference || wall_damping == 0.0))
    bounds.passive_n_per_m = std::max(0.0, damping - wall_damping) / half_period_s;
  if (velocity) {
    SampledLoop loop{plant_parameters(scene), regular ? render_period_s : scene.sampling.period_s(),
                     delay.transport_s, wall_damping, *velocity};
    loop.plant.time_constant_s = delay.time_constant_s;
    bounds.stable_n_per_m =
        regular ? largest_stable_stiffness(loop) : mean_square_stiffness(loop, scene.sampling);
  }
  if (regular && difference)
    bounds.rule_n_per_m = (damping + wall_damping) / (half_period_s + delay.total_s());
  const double encoder_m = device.encoder_m.value_or(0.0);
  if (encoder_m > 0.0) {
    if (device.friction_n) bounds.friction_n_per_m = 2.0 * *device.friction_n / encoder_m;
    if (device.force_limit_n) bounds.resolution_n_per_m = *device.force_limit_n / encoder_m;
  }
  return bounds;
}

std::optional<double> exact_stable_limit(const Scene& scene) {
  const DeviceSettings& device = scene.x().device;
  const bool bare =
      scene.algorithm.index == find_algorithm("none") && !has_follower(scene.algorithm);
  const bool linear =
      device.friction_n.value_or(0.0) == 0.0 && device.static_friction_n.value_or(0.0) == 0.0 &&
      device.encoder_m.value_or(0.0) == 0.0 && device.force_resolution_n.value_or(0.0) == 0.0;
  const bool exact = scene.simulator.integrator == Integrator::kExact;
  if (scene.x().walls.size() != 1 || !bare || !linear || !exact) return std::nullopt;
  return stability_bounds(scene, scene.x().walls.front(), delay_of(scene)).stable_n_per_m;
}

LoopDelay delay_of(const Scene& scene) {
  return {scene.x().device.delay_ticks.value_or(0) * scene.sampling.period_s(),
          scene.x().device.amplifier_time_constant_s.value_or(0.0)};
}

}  // namespace hapticwall
