// From metres along the device's axis to the picture and back.
#pragma once

#include <glm/glm.hpp>

#include "core/scene.h"

namespace hapticwall::ui {

// The part of the axis that the picture shows, metres.
struct AxisExtent {
  double from_m = 0.0;
  double to_m = 0.0;

  friend bool operator==(const AxisExtent&, const AxisExtent&) = default;
};

// Everything that a scene names (start, walls, the hand's path) with some air around it.
[[nodiscard]] AxisExtent axis_extent(const Scene& scene);

// Looks at the axis from the side of free space, from a little above. The extent is kLength long in
// the picture's own units, whatever it is in metres; the axis is the line y = z = 0.
class WallCamera {
 public:
  static constexpr float kLength = 10.0F;

  // `width` and `height` of the picture in pixels, at least 1.
  WallCamera(AxisExtent extent, float width, float height);

  [[nodiscard]] float x_of(double position_m) const;
  [[nodiscard]] double units_per_m() const { return units_per_m_; }
  [[nodiscard]] const glm::mat4& view_projection() const { return view_projection_; }
  [[nodiscard]] const glm::vec3& eye() const { return eye_; }

  // Pixels from the upper left corner.
  [[nodiscard]] glm::vec2 pixel_of(glm::vec3 point) const;
  // The position on the axis under a pixel, within the extent.
  [[nodiscard]] double position_at(glm::vec2 pixel) const;

 private:
  AxisExtent extent_;
  glm::vec2 size_;
  double units_per_m_;
  glm::vec3 eye_{0.0F};
  glm::mat4 view_projection_{1.0F};
};

}  // namespace hapticwall::ui
