// Measures of the wall view in the picture's units, and the picture as a camera sees it.
#pragma once

#include <glm/glm.hpp>

#include "app/draw/plot/theme.h"
#include "app/draw/wall/wall_picture.h"

namespace hapticwall::ui {

using draw::Axis;
using draw::kAxisCount;
using draw::PictureWall;
using draw::Reach;
using draw::ShownStiffness;
using draw::StiffnessScale;
using draw::Swept;
using draw::SweptForce;
using draw::SweptPlace;
using draw::wall_picture;
using draw::WallPicture;

[[nodiscard]] inline glm::vec4 rgba(const ImVec4& colour) {
  return {colour.x, colour.y, colour.z, colour.w};
}

class WallCamera;

// A picture as a camera sees it, in the colours of a theme.
struct WallView {
  const WallPicture& picture;
  const WallCamera& camera;
  const draw::Theme& theme;
};

// Measures in the picture's units, for solids and labels.
struct WallMeasures {
  static constexpr float kHandleRadius = 0.42F;
  static constexpr float kHandleLength = 2.7F;
  static constexpr float kStylusLength = 2.6F;  // length of a handle that moves on two axes
  // Start of the sleeve, the hand around the handle; behind the tip.
  static constexpr float kSleeveFrom = 2.3F;
  static constexpr float kSleeveTo = 1.35F;
  static constexpr float kSleeveRadius = 0.46F;
  static constexpr float kArrowHeight = 0.95F;  // height of the arrow above a single axis
  static constexpr float kMaxArrow = 3.4F;
  static constexpr float kLimitMark = 0.34F;  // half height of the mark at the force limit
  static constexpr float kFloor = -1.25F;
  static constexpr float kWallTop = 1.65F;
  static constexpr float kWallHalfDepth = 1.5F;  // half depth of a wall on a single axis
  static constexpr float kFarEnd = 6.2F;         // end of the last wall
  // Height of walls on two axes: lower, so that they hide nothing.
  static constexpr float kCornerTop = 0.75F;
  static constexpr float kCornerFront = 4.6F;  // end of these walls in free space

  [[nodiscard]] static float wall_top(const WallPicture& picture) {
    return picture.two_axes ? kCornerTop : kWallTop;
  }
};

// The arrow of a force along the device's axes, positive into the wall; as long as kMaxArrow at
// full scale, never longer.
[[nodiscard]] inline glm::vec2 arrow_of(const WallPicture& picture, glm::dvec2 force_n) {
  return -WallMeasures::kMaxArrow * glm::vec2(draw::force_share(picture, force_n));
}

}  // namespace hapticwall::ui
