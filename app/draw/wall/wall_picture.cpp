#include "app/draw/wall/wall_picture.h"

#include <algorithm>
#include <cmath>

namespace hapticwall::draw {
namespace {

constexpr double kDefaultFullScaleN = 10.0;  // if the device has no force limit
constexpr double kMinFullScaleN = 1e-9;
constexpr double kMinStiffnessNPerM = 1.0;
constexpr double kSettledTint = 1e-3;  // a tint this near has settled
constexpr float kMiddleShare = 0.5F;   // position of the middle colour of stiffness

double towards(double from, double to, double share) {
  const double value = from + share * (to - from);
  return std::abs(to - value) < kSettledTint * std::max(std::abs(to), 1.0) ? to : value;
}

}  // namespace

void note_swept(Swept& swept, const SampleHistory& history) {
  if (history.empty()) {
    swept = {};
    return;
  }
  const std::size_t size = history.size();
  const auto end_tick = static_cast<std::uint64_t>(history.value(&Sample::tick, size - 1)) + 1;
  if (end_tick == swept.end_tick) return;
  // The newest sample alone counts after a reset or without an earlier frame.
  const bool goes_on = swept.end_tick > 0 && swept.end_tick < end_tick;
  const std::uint64_t count = goes_on ? end_tick - swept.end_tick : 1;
  const IndexRange range{size - std::min<std::size_t>(count, size), size};
  swept = {history.extremes(&PlantTruth::position_m, range),
           history.extremes(&Sample::force_n, range), end_tick};
}

void sweep(WallPicture& picture, Axis axis, const Swept& swept) {
  if (swept.end_tick == 0) return;
  const auto extend = [axis](Reach& reach, const glm::dvec2& newest, const Extremes& all) {
    const int i = index_of(axis);
    reach.below[i] = std::max(0.0, newest[i] - all.minimum);
    reach.above[i] = std::max(0.0, all.maximum - newest[i]);
  };
  extend(picture.handle_reach_m, picture.handle_m, swept.place_m);
  extend(picture.force_reach_n, picture.force_n, swept.force_n);
}

WallPicture wall_picture(const Scene& scene, const Tick& tick) {
  WallPicture picture;
  picture.two_axes = scene.two_axes();
  picture.full_scale_n = 0.0;
  const bool any_hand = std::ranges::any_of(
      scene.axes, [](const AxisSettings& axis) { return axis.hand.has_value(); });
  if (any_hand) picture.hand_m.emplace(0.0);
  for (int i = 0; i < static_cast<int>(scene.axes.size()); ++i) {
    const auto index = static_cast<std::size_t>(i);
    const AxisSettings& axis = scene.axes[index];
    const Sample& sample = tick.axes.at(index);
    picture.handle_m[i] = sample.truth.position_m;
    // A hand on one axis only stays beside the handle on the other.
    if (any_hand)
      (*picture.hand_m)[i] = axis.hand ? sample.truth.hand_path_m : sample.truth.position_m;
    for (const WallSettings& wall : axis.walls)
      picture.walls.push_back({static_cast<Axis>(i), wall.position_m, wall.stiffness_n_per_m});
    picture.force_n[i] = sample.force_n;
    picture.full_scale_n =
        std::max(picture.full_scale_n, axis.device.force_limit_n.value_or(kDefaultFullScaleN));
    picture.has_limit = picture.has_limit || axis.device.force_limit_n.has_value();
    picture.saturated = picture.saturated || (sample.flags & kFlagForceLimit) != 0U;
  }
  std::stable_sort(picture.walls.begin(), picture.walls.end(),
                   [](const PictureWall& a, const PictureWall& b) { return a.face_m < b.face_m; });
  return picture;
}

WallPicture wall_picture(const Scene& scene, const Sample& sample) {
  Tick tick;
  tick.axes[0] = sample;
  return wall_picture(scene, tick);
}

const PictureWall* outermost_wall(const WallPicture& picture, Axis axis) {
  const PictureWall* outermost = nullptr;
  for (const PictureWall& wall : picture.walls) {
    if (wall.axis != axis) continue;
    if (outermost == nullptr || wall.face_m < outermost->face_m) outermost = &wall;
  }
  return outermost;
}

glm::dvec2 held_by_walls(const WallPicture& picture, glm::dvec2 place_m) {
  for (const PictureWall& wall : picture.walls) {
    double& coordinate_m = place_m[index_of(wall.axis)];
    coordinate_m = std::min(coordinate_m, wall.face_m);
  }
  return place_m;
}

std::optional<glm::dvec2> proxy_of(const WallPicture& picture) {
  const glm::dvec2 held_m = held_by_walls(picture, picture.handle_m);
  if (held_m == picture.handle_m) return std::nullopt;
  return held_m;
}

SweptPlace swept_place(const WallPicture& picture) {
  return {held_by_walls(picture, picture.handle_m - picture.handle_reach_m.below),
          held_by_walls(picture, picture.handle_m + picture.handle_reach_m.above)};
}

std::optional<glm::dvec2> deepest_place(const WallPicture& picture) {
  const glm::dvec2 place_m = picture.handle_m + picture.handle_reach_m.above;
  if (held_by_walls(picture, place_m) == place_m) return std::nullopt;
  return place_m;
}

SweptForce swept_force(const WallPicture& picture) {
  SweptForce swept{picture.force_n - picture.force_reach_n.below,
                   picture.force_n + picture.force_reach_n.above};
  for (int axis = 0; axis < static_cast<int>(kAxisCount); ++axis) {
    double& least_n = swept.least_n[axis];
    double& most_n = swept.most_n[axis];
    if (std::abs(least_n) > std::abs(most_n)) std::swap(least_n, most_n);
    if (least_n * most_n < 0.0) least_n = 0.0;
  }
  return swept;
}

glm::dvec2 force_share(const WallPicture& picture, glm::dvec2 force_n) {
  const glm::dvec2 share = force_n / std::max(picture.full_scale_n, kMinFullScaleN);
  return share / std::max(1.0, glm::length(share));
}

ShownStiffness faded(const ShownStiffness& shown, const ShownStiffness& now, double passed_s) {
  const double share = 1.0 - std::exp(-std::max(passed_s, 0.0) / kTintTimeS);
  ShownStiffness next;
  next.strength = towards(shown.strength, now.strength, share);
  if (now.strength <= 0.0) {
    next.n_per_m = shown.n_per_m;  // a tint fades in its colour
  } else if (shown.strength <= 0.0) {
    next.n_per_m = now.n_per_m;
  } else {
    next.n_per_m = towards(shown.n_per_m, now.n_per_m, share);
  }
  return next;
}

double StiffnessScale::softest_n_per_m() const {
  return stiffest_n_per_m / std::pow(10.0, kDecades);
}

float StiffnessScale::share(double n_per_m) const {
  if (n_per_m <= softest_n_per_m()) return 0.0F;
  const double decades = std::log10(n_per_m / softest_n_per_m());
  return static_cast<float>(std::min(decades / kDecades, 1.0));
}

double StiffnessScale::at(double share) const {
  return softest_n_per_m() * std::pow(10.0, share * kDecades);
}

StiffnessScale stiffness_scale(const WallPicture& picture) {
  StiffnessScale scale{kMinStiffnessNPerM};
  for (const PictureWall& wall : picture.walls)
    scale.stiffest_n_per_m = std::max(scale.stiffest_n_per_m, wall.stiffness_n_per_m);
  return scale;
}

ImVec4 stiffness_colour(const Theme& theme, float share) {
  const ImVec4 soft = mixed(theme.colour(Tone::kPanel), theme.colour(Tone::kMuted), 0.55F);
  const ImVec4 middle = mixed(theme.colour(Tone::kWarning), soft, 0.15F);
  const ImVec4& stiff = theme.colour(Tone::kWall);
  if (share < kMiddleShare) return mixed(soft, middle, share / kMiddleShare);
  return mixed(middle, stiff, (share - kMiddleShare) / (1.0F - kMiddleShare));
}

}  // namespace hapticwall::draw
