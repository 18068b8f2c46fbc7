#include "app/ui/wall_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace hapticwall::ui {
namespace {

constexpr double kSmallestExtentM = 0.02;
constexpr double kFreeSideMargin = 0.32;  // of the extent: the handle's body lies there
constexpr double kWallSideMargin = 0.12;

constexpr float kFieldOfView = glm::radians(20.0F);
constexpr float kYaw = glm::radians(-24.0F);   // towards free space
constexpr float kPitch = glm::radians(17.0F);  // above the axis
constexpr float kHalfWidth = 5.5F;             // to be seen at the axis, in the picture's units
constexpr float kHalfHeight = 2.4F;
constexpr float kNear = 0.5F;
constexpr float kFar = 100.0F;
const glm::vec3 kTarget(0.15F, -0.2F, 0.0F);

}  // namespace

AxisExtent axis_extent(const Scene& scene) {
  AxisExtent extent{scene.device.start_m, scene.device.start_m};
  const auto include = [&](double position_m) {
    extent.from_m = std::min(extent.from_m, position_m);
    extent.to_m = std::max(extent.to_m, position_m);
  };
  for (const WallSettings& wall : scene.walls) include(wall.position_m);
  if (scene.hand) {
    for (const PathPoint& point : scene.hand->path) include(point.position_m);
  }
  const double length = std::max(extent.to_m - extent.from_m, kSmallestExtentM);
  const double middle = 0.5 * (extent.from_m + extent.to_m);
  return {middle - (0.5 + kFreeSideMargin) * length, middle + (0.5 + kWallSideMargin) * length};
}

WallCamera::WallCamera(AxisExtent extent, float width, float height)
    : extent_(extent),
      size_(std::max(width, 1.0F), std::max(height, 1.0F)),
      units_per_m_(static_cast<double>(kLength) / (extent.to_m - extent.from_m)) {
  const float aspect = size_.x / size_.y;
  const float half_tangent = std::tan(0.5F * kFieldOfView);
  const float distance = std::max(kHalfHeight / half_tangent, kHalfWidth / (half_tangent * aspect));
  const glm::vec3 direction(std::sin(kYaw) * std::cos(kPitch), std::sin(kPitch),
                            std::cos(kYaw) * std::cos(kPitch));
  eye_ = kTarget + distance * direction;
  const glm::mat4 view = glm::lookAt(eye_, kTarget, glm::vec3(0.0F, 1.0F, 0.0F));
  view_projection_ = glm::perspective(kFieldOfView, aspect, kNear, kFar) * view;
}

float WallCamera::x_of(double position_m) const {
  return static_cast<float>((position_m - extent_.from_m) * units_per_m_) - 0.5F * kLength;
}

glm::vec2 WallCamera::pixel_of(glm::vec3 point) const {
  const glm::vec4 clip = view_projection_ * glm::vec4(point, 1.0F);
  const glm::vec2 device = glm::vec2(clip) / clip.w;
  return {(0.5F + 0.5F * device.x) * size_.x, (0.5F - 0.5F * device.y) * size_.y};
}

double WallCamera::position_at(glm::vec2 pixel) const {
  // A pointer that has left the picture counts as being at its edge: farther out, lines of sight
  // miss the plane of the axis.
  const glm::vec2 inside = glm::clamp(pixel, glm::vec2(0.0F), size_);
  const glm::vec2 device(2.0F * inside.x / size_.x - 1.0F, 1.0F - 2.0F * inside.y / size_.y);
  const glm::mat4 inverse = glm::inverse(view_projection_);
  const auto unproject = [&](float depth) {
    const glm::vec4 point = inverse * glm::vec4(device, depth, 1.0F);
    return glm::vec3(point) / point.w;
  };
  const glm::vec3 near = unproject(-1.0F);
  const glm::vec3 far = unproject(1.0F);
  // Where the line of sight meets the upright plane of the axis, z = 0.
  const float share = near.z / (near.z - far.z);
  const float x = near.x + share * (far.x - near.x);
  const double position_m = extent_.from_m + static_cast<double>(x + 0.5F * kLength) / units_per_m_;
  return std::clamp(position_m, extent_.from_m, extent_.to_m);
}

}  // namespace hapticwall::ui
