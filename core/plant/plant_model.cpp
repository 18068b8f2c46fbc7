#include "core/plant/plant_model.h"

namespace hapticwall {
namespace {

template <typename Body>
PlantVariant with_friction_if_named(const Scene& scene, const Body& body, const HandPath& path) {
  const double period_s = scene.sampling.period_s();
  const double friction_n = scene.device.friction_n.value_or(0.0);
  if (friction_n > 0.0)
    return ExactPlant<Body, true>(body, path, period_s, scene.device.start_m, friction_n);
  return ExactPlant<Body, false>(body, path, period_s, scene.device.start_m, 0.0);
}

HandPath make_path(const Scene& scene) {
  if (!scene.hand || scene.hand->path.empty()) return HandPath(scene.device.start_m);
  return {scene.hand->path, scene.sampling.rate_hz};
}

}  // namespace

PlantVariant make_plant(const Scene& scene) {
  const double period_s = scene.sampling.period_s();
  const DeviceSettings& device = scene.device;
  const HandPath path = make_path(scene);
  if (scene.hand && scene.hand->has_grip()) {
    const HandSettings& hand = *scene.hand;
    const TwoBodyParameters parameters{device.mass_kg,
                                       device.damping_n_s_per_m,
                                       hand.mass_kg.value_or(0.0),
                                       hand.stiffness_n_per_m,
                                       hand.damping_n_s_per_m,
                                       *hand.grip_stiffness_n_per_m,
                                       hand.grip_damping_n_s_per_m.value_or(0.0)};
    return with_friction_if_named(scene, TwoBodies(parameters, period_s), path);
  }
  OneBodyParameters parameters{device.mass_kg, device.damping_n_s_per_m, 0.0, 0.0};
  if (scene.hand) {
    parameters.mass_kg += scene.hand->mass_kg.value_or(0.0);
    parameters.hand_stiffness_n_per_m = scene.hand->stiffness_n_per_m;
    parameters.hand_damping_n_s_per_m = scene.hand->damping_n_s_per_m;
  }
  return with_friction_if_named(scene, OneBody(parameters, period_s), path);
}

}  // namespace hapticwall
