#include "app/runtime/scene_change.h"

#include <algorithm>
#include <string>
#include <utility>

namespace hapticwall::runtime {

bool same_parameters(const Scene& a, const Scene& b) {
  return same_plant(a, b) && a.algorithm == b.algorithm && a.walls == b.walls && a.y == b.y;
}

namespace {

constexpr const char* kNewSession = "cannot change while the session runs: it takes a new one";

// `axis`: "" or "y.".
std::optional<SceneProblem> axis_needs_new_session(const Scene& running, const Scene& wanted,
                                                   const std::string& axis) {
  if (wanted.device.start_m != running.device.start_m) {
    return SceneProblem{"device." + axis + "start_m", kNewSession};
  }
  if (wanted.hand.has_value() != running.hand.has_value()) {
    return SceneProblem{axis.empty() ? "hand" : "hand.y", kNewSession};
  }
  if (wanted.hand && (wanted.hand->path != running.hand->path ||
                      wanted.hand->follows_mouse != running.hand->follows_mouse)) {
    return SceneProblem{"hand." + axis + "path", kNewSession};
  }
  return std::nullopt;
}

}  // namespace

std::optional<SceneProblem> needs_new_session(const Scene& running, const Scene& wanted) {
  if (wanted.sampling.rate_hz != running.sampling.rate_hz) {
    return SceneProblem{"sampling.rate_hz", kNewSession};
  }
  if (wanted.y.has_value() != running.y.has_value()) return SceneProblem{"device.y", kNewSession};
  if (auto problem = axis_needs_new_session(running, wanted, "")) return problem;
  if (!wanted.y) return std::nullopt;
  return axis_needs_new_session(second_axis(running), second_axis(wanted), "y.");
}

Scene scene_on(Scene scene, const device::DeviceInfo& device) {
  if (device.is_simulated) return scene;
  scene.hand.reset();
  if (device.encoder_m > 0.0) scene.device.encoder_m = device.encoder_m;
  if (device.force_limit_n > 0.0) {
    scene.device.force_limit_n =
        std::min(scene.device.force_limit_n.value_or(device.force_limit_n), device.force_limit_n);
  }
  return scene;
}

}  // namespace hapticwall::runtime
