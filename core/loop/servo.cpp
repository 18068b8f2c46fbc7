#include "core/servo.h"

#include <cmath>

namespace hapticwall {

ServoSettings servo_settings(const Scene& scene) {
  ServoSettings settings;
  settings.rate_hz = scene.sampling.rate_hz;
  settings.device_damping_n_s_per_m = scene.device.damping_n_s_per_m;
  settings.encoder_m = scene.device.encoder_m.value_or(0.0);
  if (scene.device.force_limit_n) settings.force_limit_n = *scene.device.force_limit_n;
  settings.walls = WallSet(scene.walls);
  settings.algorithm = scene.algorithm;
  return settings;
}

StabiliserContext stabiliser_context(const ServoSettings& settings) {
  return {settings.period_s(), settings.device_damping_n_s_per_m, settings.encoder_m,
          settings.walls, &settings.algorithm};
}

Servo::Servo(const ServoSettings& settings) : settings_(settings) {
  configure();
  reset();
}

void Servo::configure() {
  const StabiliserContext context = stabiliser_context(settings_);
  stabilisers_.configure(context);
  follower_.configure(context);
  followed_ = has_follower(settings_.algorithm);
  state_.budget_n_per_m = believed_damping(context) * settings_.rate_hz;
}

void Servo::apply(const ServoSettings& settings) {
  state_.parameters_changed = true;
  if (settings == settings_) return;
  const bool switched = settings.algorithm.index != settings_.algorithm.index;
  const bool was_followed = followed_;
  settings_ = settings;
  configure();
  if (switched || followed_ != was_followed) follower_.reset();
  if (switched) {
    stabilisers_.visit(settings_.algorithm.index, [](auto& stabiliser) { stabiliser.reset(); });
  }
  if (state_.tick == 0) return;  // no force yet that could jump
  const double ticks = std::max(1.0, std::round(settings_.transition_s * settings_.rate_hz));
  state_.transition = {static_cast<std::uint32_t>(ticks), static_cast<std::uint32_t>(ticks), 0.0,
                       false};
}

void Servo::reset() {
  stabilisers_.reset();
  follower_.reset();
  const double budget_n_per_m = state_.budget_n_per_m;
  const double force_gain = state_.force_gain;
  state_ = ServoState{};
  state_.budget_n_per_m = budget_n_per_m;
  state_.force_gain = force_gain;
}

}  // namespace hapticwall
