#include "app/runtime/scene_change.h"

#include <algorithm>

namespace hapticwall::runtime {
namespace {

bool same_wall(const WallSettings& a, const WallSettings& b) {
  return a.position_m == b.position_m && a.stiffness_n_per_m == b.stiffness_n_per_m &&
         a.damping_n_s_per_m == b.damping_n_s_per_m;
}

}  // namespace

bool same_parameters(const Scene& a, const Scene& b) {
  return same_plant(a, b) && a.algorithm == b.algorithm &&
         std::equal(a.walls.begin(), a.walls.end(), b.walls.begin(), b.walls.end(), same_wall);
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

}  // namespace hapticwall::runtime
