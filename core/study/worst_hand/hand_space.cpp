#include "core/study/worst_hand/hand_space.h"

#include <algorithm>
#include <cmath>

namespace hapticwall::worst_hand {
namespace {

// low (high/low)^place, by the binary digits of `place`. A square root rounds the same everywhere,
// a power does not.
double geometric(const ValueRange& range, double place) {
  constexpr int kDigits = 52;
  double ratio = range.maximum / range.minimum;
  if (place >= 1.0) return range.maximum;
  double value = range.minimum;
  for (int i = 0; i < kDigits && place > 0.0; ++i) {
    ratio = std::sqrt(ratio);
    place *= 2.0;
    if (place < 1.0) continue;
    place -= 1.0;
    value *= ratio;
  }
  return value;
}

constexpr std::size_t kPress = 5;

const WallSettings& outermost_wall(const Scene& scene) {
  return *std::ranges::min_element(scene.x().walls, {}, &WallSettings::position_m);
}

}  // namespace

HandValues values_at(const HandPoint& point, Bounds bounds) {
  HandValues values{};
  for (std::size_t i = 0; i < kHandNumbers; ++i) {
    values.at(i) =
        geometric(kHandNumberList.at(i).ranges.at(static_cast<std::size_t>(bounds)), point.at(i));
  }
  return values;
}

bool is_at_bound(const HandValues& values, std::size_t number, Bounds bounds) {
  constexpr double kNear = 1.01;
  const ValueRange& range = kHandNumberList.at(number).ranges.at(static_cast<std::size_t>(bounds));
  return values.at(number) < kNear * range.minimum || kNear * values.at(number) > range.maximum;
}

Scene with_hand(const Scene& scene, const HandValues& values, Motion motion) {
  const auto [mass, stiffness, damping, grip_stiffness, grip_damping, press_n, speed] = values;
  const WallSettings& wall = outermost_wall(scene);
  HandSettings hand;
  hand.mass_kg = mass;
  hand.stiffness_n_per_m = stiffness;
  hand.damping_n_s_per_m = damping;
  hand.grip_stiffness_n_per_m = grip_stiffness;
  hand.grip_damping_n_s_per_m = grip_damping;
  const double start_m = scene.x().device.start_m;
  const double end_m = wall.position_m + press_n / stiffness + press_n / wall.stiffness_n_per_m;
  hand.path = {{0.0, end_m}};
  if (motion == Motion::kRamp) hand.path = {{0.0, start_m}, {(end_m - start_m) / speed, end_m}};
  Scene with = scene;
  with.x().hand = std::move(hand);
  return with;
}

double rest_s(const Scene& scene) { return scene.x().hand->path.back().time_s; }

std::optional<SceneProblem> problem_of(const Scene& scene, Bounds bounds) {
  if (scene.x().walls.empty()) return SceneProblem{"wall", "the search needs a wall"};
  const WallSettings& wall = outermost_wall(scene);
  if (!(wall.stiffness_n_per_m > 0.0))
    return SceneProblem{"wall", "the search needs an outermost wall with a stiffness"};
  if (scene.x().device.start_m >= wall.position_m)
    return SceneProblem{"device.start_m", "the search starts in front of the walls"};
  // The farthest path: the strongest press of the softest hand.
  HandPoint farthest{};
  farthest.at(kPress) = 1.0;
  return validate(with_hand(scene, values_at(farthest, bounds)));
}

}  // namespace hapticwall::worst_hand
