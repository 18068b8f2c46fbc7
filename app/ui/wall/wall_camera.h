// Transforms between metres on the device axes and the picture.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "core/scene.h"

namespace hapticwall::ui {

// The part of an axis that the picture shows, metres.
struct AxisExtent {
  double from_m = 0.0;
  double to_m = 0.0;

  [[nodiscard]] double length_m() const { return to_m - from_m; }
  [[nodiscard]] double middle_m() const { return 0.5 * (from_m + to_m); }
  friend bool operator==(const AxisExtent&, const AxisExtent&) = default;
};

// Contains all positions of a scene (start, walls, hand path), with some margin.
[[nodiscard]] AxisExtent axis_extent(const AxisSettings& axis);

// The shown part of one or two device axes.
struct WallSpace {
  AxisExtent x;
  std::optional<AxisExtent> y;

  friend bool operator==(const WallSpace&, const WallSpace&) = default;
};
[[nodiscard]] WallSpace wall_space(const Scene& scene);

// Rotation, zoom and shift by the user, relative to the initial view.
struct WallOrbit {
  double yaw_rad = 0.0;    // positive: the eye goes round to the wall's side
  double pitch_rad = 0.0;  // positive: the eye goes up
  double zoom = 1.0;
  glm::dvec2 shift{0.0};  // of the picture, in halves of its width and height, to the right and up

  friend bool operator==(const WallOrbit&, const WallOrbit&) = default;
};

// `orbit` clamped to useful views: axes are never seen end-on or from below, and part of the scene
// stays in the picture.
[[nodiscard]] WallOrbit limited(const WallOrbit& orbit, bool two_axes);
// Zooms by `factor` around the pointer. `pointer` as WallOrbit::shift.
[[nodiscard]] WallOrbit zoomed(const WallOrbit& orbit, double factor, glm::dvec2 pointer);

// Looks at the axes from the side of free space, from a little above. The longer extent is kLength
// long in the picture's own units, whatever it is in metres. The axes lie in the level y = 0: the
// device's x to the right (x), its y away from the viewer (-z). With one axis that is the line
// y = z = 0. Zoom and shift act on the finished picture: the eye never comes near to anything.
class WallCamera {
 public:
  static constexpr float kLength = 10.0F;

  // `width` and `height` of the picture in pixels, at least 1. `orbit` is limited().
  WallCamera(const WallSpace& space, const WallOrbit& orbit, float width, float height);
  WallCamera(AxisExtent extent, float width, float height)
      : WallCamera(WallSpace{extent, std::nullopt}, WallOrbit{}, width, height) {}

  // The picture's coordinates of positions on the first and on the second axis.
  [[nodiscard]] float x_of(double position_m) const;
  [[nodiscard]] float z_of(double position_m) const;  // 0 on a single axis
  // The point of a place on the axes, `height` units above their level.
  [[nodiscard]] glm::vec3 point_of(glm::dvec2 place_m, float height = 0.0F) const {
    return {x_of(place_m.x), height, z_of(place_m.y)};
  }
  [[nodiscard]] const WallSpace& space() const { return space_; }
  [[nodiscard]] double units_per_m() const { return units_per_m_; }
  // Size at the middle of the picture, perpendicular to the line of sight.
  [[nodiscard]] double pixels_per_unit() const { return pixels_per_unit_; }
  [[nodiscard]] const glm::mat4& view_projection() const { return view_projection_; }
  [[nodiscard]] const glm::vec3& eye() const { return eye_; }

  // Pixels from the upper left corner.
  [[nodiscard]] glm::vec2 pixel_of(glm::vec3 point) const;
  // The position on a single axis that is nearest to a pixel, within the extent.
  [[nodiscard]] double position_at(glm::vec2 pixel) const;
  // The position on two axes under a pixel, clamped to the extents. With one axis: (position_at(),
  // 0).
  [[nodiscard]] glm::dvec2 place_at(glm::vec2 pixel) const;

 private:
  WallSpace space_;
  glm::dvec2 size_;
  double units_per_m_;
  double pixels_per_unit_ = 1.0;
  glm::vec3 eye_{0.0F};
  glm::dmat4 exact_{1.0};
  glm::mat4 view_projection_{1.0F};
};

}  // namespace hapticwall::ui
