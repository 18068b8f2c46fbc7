#include "app/runtime/scene_change.h"

#include <algorithm>
#include <utility>

namespace hapticwall::runtime {

bool same_parameters(const Scene& a, const Scene& b) {
  return same_plant(a, b) && a.algorithm == b.algorithm && a.walls == b.walls;
}

std::optional<SceneProblem> needs_new_session(const Scene& running, const Scene& wanted) {
  const auto refused = [](const char* key) {
    return SceneProblem{key, "cannot change while the session runs: it takes a new one"};
  };
  if (wanted.sampling.rate_hz != running.sampling.rate_hz) return refused("sampling.rate_hz");
  if (wanted.device.start_m != running.device.start_m) return refused("device.start_m");
  if (wanted.hand.has_value() != running.hand.has_value()) return refused("hand");
  if (wanted.hand && (wanted.hand->path != running.hand->path ||
                      wanted.hand->follows_mouse != running.hand->follows_mouse)) {
    return refused("hand.path");
  }
  return std::nullopt;
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
