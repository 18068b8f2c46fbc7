#include "app/session/scene_change.h"

#include <algorithm>

#include "core/scene_keys.h"

namespace hapticwall::session {

bool same_parameters(const Scene& a, const Scene& b) {
  return a.sampling == b.sampling && a.axes == b.axes && a.algorithm == b.algorithm &&
         a.environment == b.environment && a.estimator == b.estimator && a.simulator == b.simulator;
}

namespace {

constexpr const char* kNewSession = "cannot change while the session runs: start a new session";

std::optional<SceneProblem> axis_needs_new_session(const AxisSettings& running,
                                                   const AxisSettings& wanted, std::size_t index) {
  if (wanted.device.start_m != running.device.start_m) {
    return SceneProblem{axis_key("device", index) + ".start_m", kNewSession};
  }
  if (wanted.hand.has_value() != running.hand.has_value()) {
    return SceneProblem{axis_key("hand", index), kNewSession};
  }
  if (wanted.hand && (wanted.hand->path != running.hand->path ||
                      wanted.hand->follows_mouse != running.hand->follows_mouse)) {
    return SceneProblem{axis_key("hand", index) + ".path", kNewSession};
  }
  return std::nullopt;
}

// `limit` 0: none.
void lower(std::optional<double>& setting, double limit) {
  if (limit > 0.0) setting = std::min(setting.value_or(limit), limit);
}

}  // namespace

std::optional<SceneProblem> needs_new_session(const Scene& running, const Scene& wanted) {
  if (wanted.sampling.rate_hz != running.sampling.rate_hz) {
    return SceneProblem{"sampling.rate_hz", kNewSession};
  }
  if (!wanted.sampling.same_clock(running.sampling)) return SceneProblem{"sampling", kNewSession};
  if (wanted.axes.size() != running.axes.size()) return SceneProblem{"device.y", kNewSession};
  for (std::size_t i = 0; i < wanted.axes.size(); ++i) {
    if (auto problem = axis_needs_new_session(running.axes[i], wanted.axes[i], i)) {
      return problem;
    }
  }
  return std::nullopt;
}

Scene scene_on(Scene scene, const device::DeviceInfo& device) {
  if (device.is_simulated) return scene;
  scene.x().hand.reset();
  DeviceSettings& settings = scene.x().device;
  if (device.encoder_m > 0.0) settings.encoder_m = device.encoder_m;
  lower(settings.force_limit_n, device.force_limit_n);
  if (settings.max_force_rate_n_per_s == 0.0) settings.max_force_rate_n_per_s.reset();
  lower(settings.max_force_rate_n_per_s, device.max_force_rate_n_per_s);
  return scene;
}

}  // namespace hapticwall::session
