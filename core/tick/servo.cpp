#include "core/tick/servo.h"

#include <cmath>

namespace hapticwall {

ServoSettings servo_settings(const Scene& scene) {
  ServoSettings settings;
  settings.rate_hz = scene.sampling.rate_hz;
  settings.skipped = {static_cast<std::uint64_t>(scene.sampling.render_every.value_or(1)),
                      scene.sampling.lost_ticks.value_or(0.0), scene.sampling.seed.value_or(1)};
  settings.device_damping_n_s_per_m = scene.x().device.damping_n_s_per_m;
  settings.encoder_m = scene.x().device.encoder_m.value_or(0.0);
  if (scene.x().device.force_limit_n) settings.force_limit_n = *scene.x().device.force_limit_n;
  if (const double rate = scene.x().device.max_force_rate_n_per_s.value_or(0.0); rate > 0.0) {
    settings.max_rise_n = rate * settings.period_s();
  }
  settings.walls = WallSet(scene.x().walls);
  settings.axis = static_cast<std::uint32_t>(scene.first_axis);
  settings.environment = chosen_environment(scene.environment);
  settings.environment_settings = scene.environment;
  settings.estimator = chosen_estimator(scene.estimator);
  settings.estimator_settings = scene.estimator;
  settings.algorithm = scene.algorithm;
  settings.both_axes = settings.environment != nullptr || reads_other_axis(scene.algorithm);
  return settings;
}

AlgorithmContext algorithm_context(const ServoSettings& settings) {
  return {1.0 / settings.render_rate_hz(),
          settings.device_damping_n_s_per_m,
          settings.encoder_m,
          settings.walls,
          &settings.algorithm,
          settings.force_limit_n};
}

Servo::Servo(const ServoSettings& settings) : settings_(settings) {
  configure();
  reset();
}

void Servo::configure() {
  const AlgorithmContext context = algorithm_context(settings_);
  parts_.estimator.configure(settings_.estimator, {settings_.render_rate_hz(), settings_.encoder_m,
                                                   &settings_.estimator_settings});
  parts_.environment.configure(settings_.environment,
                               {context.period_s, &settings_.environment_settings, settings_.axis});
  parts_.algorithm.configure(settings_.algorithm, context);
  damping_n_s_per_m_ = believed_damping(context);
  state_.budget_n_per_m = damping_n_s_per_m_ * settings_.rate_hz;
  if (settings_.plain()) state_.last = {};
  state_.last.outdated = true;
}

void Servo::apply(const ServoSettings& settings) {
  state_.parameters_changed = true;
  if (settings == settings_) return;
  settings_ = settings;
  configure();
  if (state_.tick == 0) return;  // no force yet, no kick
  const double ticks = std::max(1.0, std::round(settings_.transition_s * settings_.rate_hz));
  state_.transition = {static_cast<std::uint32_t>(ticks), static_cast<std::uint32_t>(ticks), 0.0,
                       false};
}

void Servo::reset() {
  parts_.reset();
  const double budget_n_per_m = state_.budget_n_per_m;
  const double force_gain = state_.force_gain;
  state_ = ServoState{};
  state_.budget_n_per_m = budget_n_per_m;
  state_.force_gain = force_gain;
}

}  // namespace hapticwall
