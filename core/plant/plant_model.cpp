#include "core/plant/plant_model.h"

namespace hapticwall {
namespace {

template <typename Real, typename Body>
ExactPlantVariant<Real> make_exact_with(const Scene& scene, const PlantParameters& parameters) {
  const double period_s = scene.sampling.period_s();
  const Body body(parameters, period_s);
  const HandPath path = hand_path(scene);
  const double start_m = scene.x().device.start_m;
  if (!parameters.has_friction())
    return ExactPlant<Body, false>(body, path, period_s, start_m, 0.0);
  return ExactPlant<Body, true>(body, path, period_s, start_m, parameters.friction_n);
}

template <typename Real, bool kLag>
ExactPlantVariant<Real> make_exact_with_lag(const Scene& scene, const PlantParameters& parameters) {
  return parameters.grip ? make_exact_with<Real, LinearBody<Real, true, kLag>>(scene, parameters)
                         : make_exact_with<Real, LinearBody<Real, false, kLag>>(scene, parameters);
}

template <typename Real>
ExactPlantVariant<Real> make_exact_plant(const Scene& scene) {
  const PlantParameters parameters = plant_parameters(scene);
  return parameters.has_lag() ? make_exact_with_lag<Real, true>(scene, parameters)
                              : make_exact_with_lag<Real, false>(scene, parameters);
}

template <typename Scheme>
SteppedPlant<Scheme> make_stepped_plant(const Scene& scene) {
  return {plant_parameters(scene), hand_path(scene), scene.sampling.period_s(),
          scene.x().device.start_m, scene.simulator.substeps};
}

PlantVariant widened(ExactPlantVariant<double> exact) {
  return std::visit([](auto& plant) -> PlantVariant { return std::move(plant); }, exact);
}

}  // namespace

HandPath hand_path(const Scene& scene) {
  const bool led = scene.x().hand && !scene.x().hand->path.empty();
  HandPath path = led ? HandPath(scene.x().hand->path, scene.sampling.rate_hz)
                      : HandPath(scene.x().device.start_m, scene.sampling.rate_hz);
  if (scene.sampling.jitter.value_or(0.0) > 0.0) path.allow_any_period();
  return path;
}

PlantParameters plant_parameters(const Scene& scene) {
  const DeviceSettings& device = scene.x().device;
  PlantParameters parameters;
  parameters.mass_kg = device.mass_kg;
  parameters.damping_n_s_per_m = device.damping_n_s_per_m;
  parameters.friction_n = device.friction_n.value_or(0.0);
  parameters.static_friction_n = device.static_friction_n.value_or(0.0);
  parameters.stribeck_speed_m_per_s = device.stribeck_speed_m_per_s.value_or(0.0);
  parameters.time_constant_s = device.amplifier_time_constant_s.value_or(0.0);
  if (!scene.x().hand) return parameters;
  const HandSettings& hand = *scene.x().hand;
  parameters.hand_stiffness_n_per_m = hand.stiffness_n_per_m;
  parameters.hand_damping_n_s_per_m = hand.damping_n_s_per_m;
  parameters.grip = hand.has_grip();
  if (parameters.grip) {
    parameters.hand_mass_kg = hand.mass_kg.value_or(0.0);
    parameters.grip_stiffness_n_per_m = *hand.grip_stiffness_n_per_m;
    parameters.grip_damping_n_s_per_m = hand.grip_damping_n_s_per_m.value_or(0.0);
  } else {
    parameters.mass_kg += hand.mass_kg.value_or(0.0);
  }
  return parameters;
}

PlantVariant make_plant(const Scene& scene) {
  switch (scene.simulator.integrator) {
    case Integrator::kExact:
      return widened(make_exact_plant<double>(scene));
    case Integrator::kSemiImplicitEuler:
      return make_stepped_plant<SemiImplicitEuler>(scene);
    case Integrator::kRungeKutta4:
      break;
  }
  return make_stepped_plant<RungeKutta4>(scene);
}

ReferencePlantVariant make_reference_plant(const Scene& scene) {
  return make_exact_plant<long double>(scene);
}

PlantModel::PlantModel(const Scene& scene)
    : plant_(make_plant(scene)),
      output_(scene),
      encoder_m_(scene.x().device.encoder_m.value_or(0.0)),
      variation_(scene) {
  refresh();
}

bool PlantModel::has_diverged() const {
  return std::visit([](const auto& plant) { return !plant.in_reach(plant.motion()); }, plant_);
}

bool PlantModel::gave_up() const {
  return std::visit([](const auto& plant) { return plant.gave_up(); }, plant_);
}

void PlantModel::advance(double force_n) {
  const double passed_n = output_.pass(force_n);
  std::visit(
      [&](auto& plant) {
        const auto from_m = plant.position_m();
        advance_plant(plant, variation_, tick_, passed_n - pushed_n_);
        if (pushed_n_ != 0.0) plant.credit_push(pushed_n_ * (plant.position_m() - from_m));
      },
      plant_);
  ++tick_;
  refresh();
}

void PlantModel::push_hand(double force_n) {
  if (force_n == pushed_n_) return;
  std::visit([&](auto& plant) { plant.push(force_n - pushed_n_); }, plant_);
  pushed_n_ = force_n;
  refresh();
}

void PlantModel::reset() {
  output_.reset();
  tick_ = 0;
  pushed_n_ = 0.0;
  std::visit([](auto& plant) { plant.reset(); }, plant_);
  refresh();
}

void PlantModel::lead_hand_to(double position_m) {
  std::visit([&](auto& plant) { plant.path().lead_to(position_m); }, plant_);
  refresh();
}

void PlantModel::release_hand() {
  std::visit([](auto& plant) { plant.path().release(); }, plant_);
  refresh();
}

void PlantModel::take_over(PlantModel& other) {
  const double pushed_n = other.pushed_n_;
  other.push_hand(0.0);
  std::visit(
      [&](auto& old) {
        const auto state = old.hand_over(other.output_.last_n());
        std::visit([&](auto& plant) { plant.take_over(state, old.path()); }, plant_);
      },
      other.plant_);
  output_.take_over(other.output_, other.output_.last_n());
  tick_ = other.tick_;
  push_hand(pushed_n);
  refresh();
}

void PlantModel::refresh() {
  std::visit([&](auto& plant) { plant.write_truth(plant.motion(), truth_); }, plant_);
  truth_.hand_force_n += pushed_n_;
}

}  // namespace hapticwall
