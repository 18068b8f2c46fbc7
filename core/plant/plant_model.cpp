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
  if (!scene.hand || scene.hand->path.empty()) {
    return {scene.device.start_m, scene.sampling.rate_hz};
  }
  return {scene.hand->path, scene.sampling.rate_hz};
}

PlantVariant make_exact_plant(const Scene& scene, const HandPath& path) {
  const double period_s = scene.sampling.period_s();
  const DeviceSettings& device = scene.device;
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

SteppedParameters stepped_parameters(const Scene& scene) {
  SteppedParameters parameters;
  parameters.mass_kg = scene.device.mass_kg;
  parameters.damping_n_s_per_m = scene.device.damping_n_s_per_m;
  parameters.friction_n = scene.device.friction_n.value_or(0.0);
  if (!scene.hand) return parameters;
  const HandSettings& hand = *scene.hand;
  parameters.hand_stiffness_n_per_m = hand.stiffness_n_per_m;
  parameters.hand_damping_n_s_per_m = hand.damping_n_s_per_m;
  if (hand.has_grip()) {
    parameters.hand_mass_kg = hand.mass_kg.value_or(0.0);
    parameters.grip_stiffness_n_per_m = *hand.grip_stiffness_n_per_m;
    parameters.grip_damping_n_s_per_m = hand.grip_damping_n_s_per_m.value_or(0.0);
  } else {
    parameters.mass_kg += hand.mass_kg.value_or(0.0);
  }
  return parameters;
}

template <typename Plant>
PlantVariant make_stepped(const Scene& scene, const HandPath& path) {
  return Plant(stepped_parameters(scene), path, scene.sampling.period_s(), scene.device.start_m,
               scene.simulator.substeps);
}

template <template <bool, bool> class Scheme>
PlantVariant make_stepped_plant(const Scene& scene, const HandPath& path) {
  const bool friction = scene.device.friction_n.value_or(0.0) > 0.0;
  if (scene.hand && scene.hand->has_grip()) {
    return friction ? make_stepped<SteppedPlant<Scheme, true, true>>(scene, path)
                    : make_stepped<SteppedPlant<Scheme, true, false>>(scene, path);
  }
  return friction ? make_stepped<SteppedPlant<Scheme, false, true>>(scene, path)
                  : make_stepped<SteppedPlant<Scheme, false, false>>(scene, path);
}

}  // namespace

PlantVariant make_plant(const Scene& scene) {
  const HandPath path = make_path(scene);
  switch (scene.simulator.integrator) {
    case Integrator::kExact:
      return make_exact_plant(scene, path);
    case Integrator::kSemiImplicitEuler:
      return make_stepped_plant<SemiImplicitEuler>(scene, path);
    case Integrator::kRungeKutta4:
      break;
  }
  return make_stepped_plant<RungeKutta4>(scene, path);
}

}  // namespace hapticwall
