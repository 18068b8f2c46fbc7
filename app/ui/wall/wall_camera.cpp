#include "app/ui/wall/wall_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace hapticwall::ui {
namespace {

constexpr double kMinExtentM = 0.02;
constexpr double kFreeSideMargin = 0.32;  // share of the extent; room for the body of the handle
constexpr double kWallSideMargin = 0.12;

constexpr double kFieldOfView = glm::radians(20.0);
constexpr double kNear = 0.5;
constexpr double kBehind = 60.0;  // reach of the picture beyond the middle of the scene

// Initial view and limits of the rotation.
struct View {
  double yaw_rad;    // angle from the front towards the wall's side
  double pitch_rad;  // angle above the plane of the axes
  double lowest_pitch_rad;
  double half_width;  // half of the visible extent around the target, in the picture's units
  double half_height;
  glm::dvec3 target;
};
const View kOneAxisView{glm::radians(-24.0), glm::radians(17.0), glm::radians(4.0), 5.5, 2.4,
                        {0.15, -0.2, 0.0}};
// Low enough to see the faces of the walls; every line of sight meets the plane of the axes.
const View kTwoAxesView{glm::radians(-26.0), glm::radians(36.0), glm::radians(20.0), 8.0, 4.9,
                        {0.3, -0.6, -0.3}};
constexpr double kMaxYaw = glm::radians(75.0);
constexpr double kHighestPitch = glm::radians(80.0);
constexpr double kMinZoom = 0.8;
constexpr double kMaxZoom = 20.0;
constexpr double kFreeShift = 0.5;  // max shift without any zoom
// The middle of a zoomed picture stays within this share of the unzoomed one.
const glm::dvec2 kShownShare(0.9, 0.75);

const View& view_of(bool two_axes) { return two_axes ? kTwoAxesView : kOneAxisView; }

AxisExtent with_margins(double from_m, double to_m) {
  const double length_m = std::max(to_m - from_m, kMinExtentM);
  const double middle_m = 0.5 * (from_m + to_m);
  return {middle_m - (0.5 + kFreeSideMargin) * length_m,
          middle_m + (0.5 + kWallSideMargin) * length_m};
}

}  // namespace

AxisExtent axis_extent(const AxisSettings& axis) {
  double from_m = axis.device.start_m;
  double to_m = from_m;
  const auto include = [&](double position_m) {
    from_m = std::min(from_m, position_m);
    to_m = std::max(to_m, position_m);
  };
  for (const WallSettings& wall : axis.walls) include(wall.position_m);
  if (axis.hand) {
    for (const PathPoint& point : axis.hand->path) include(point.position_m);
  }
  return with_margins(from_m, to_m);
}

WallSpace wall_space(const Scene& scene) {
  WallSpace space{axis_extent(scene.x()), std::nullopt};
  if (scene.two_axes()) space.y = axis_extent(scene.axes[1]);
  return space;
}

WallOrbit limited(const WallOrbit& orbit, bool two_axes) {
  const View& view = view_of(two_axes);
  // A stored state may hold any value.
  const auto within = [](double value, double from, double to, double otherwise) {
    return std::isfinite(value) ? std::clamp(value, from, to) : otherwise;
  };
  WallOrbit result;
  result.yaw_rad = within(orbit.yaw_rad, -kMaxYaw - view.yaw_rad, kMaxYaw - view.yaw_rad, 0.0);
  result.pitch_rad = within(orbit.pitch_rad, view.lowest_pitch_rad - view.pitch_rad,
                            kHighestPitch - view.pitch_rad, 0.0);
  result.zoom = within(orbit.zoom, kMinZoom, kMaxZoom, 1.0);
  for (int i = 0; i < 2; ++i) {
    const double reach = kFreeShift + kShownShare[i] * std::max(0.0, result.zoom - 1.0);
    result.shift[i] = within(orbit.shift[i], -reach, reach, 0.0);
  }
  return result;
}

WallOrbit zoomed(const WallOrbit& orbit, double factor, glm::dvec2 pointer) {
  WallOrbit result = orbit;
  result.zoom = std::clamp(orbit.zoom * factor, kMinZoom, kMaxZoom);
  result.shift = pointer - (pointer - orbit.shift) * (result.zoom / orbit.zoom);
  return result;
}

WallCamera::WallCamera(const WallSpace& space, const WallOrbit& orbit, float width, float height)
    : space_(space),
      size_(std::max(width, 1.0F), std::max(height, 1.0F)),
      units_per_m_(static_cast<double>(kLength) /
                   std::max(space.x.length_m(), space.y ? space.y->length_m() : 0.0)) {
  const bool two_axes = space.y.has_value();
  const View& view = view_of(two_axes);
  const WallOrbit turned = limited(orbit, two_axes);
  const double aspect = size_.x / size_.y;
  const double half_tangent = std::tan(0.5 * kFieldOfView);
  const double distance =
      std::max(view.half_height / half_tangent, view.half_width / (half_tangent * aspect));
  const double yaw = view.yaw_rad + turned.yaw_rad;
  const double pitch = view.pitch_rad + turned.pitch_rad;
  const glm::dvec3 direction(std::sin(yaw) * std::cos(pitch), std::sin(pitch),
                             std::cos(yaw) * std::cos(pitch));
  const glm::dvec3 eye = view.target + distance * direction;
  glm::dmat4 picture(1.0);  // zoom and shift of the finished picture
  picture[0][0] = turned.zoom;
  picture[1][1] = turned.zoom;
  picture[3][0] = turned.shift.x;
  picture[3][1] = turned.shift.y;
  exact_ = picture * glm::perspective(kFieldOfView, aspect, kNear, distance + kBehind) *
           glm::lookAt(eye, view.target, glm::dvec3(0.0, 1.0, 0.0));
  eye_ = glm::vec3(eye);
  view_projection_ = glm::mat4(exact_);
  pixels_per_unit_ = 0.5 * size_.y * turned.zoom / (half_tangent * distance);
}

float WallCamera::x_of(double position_m) const {
  return static_cast<float>((position_m - space_.x.middle_m()) * units_per_m_);
}

float WallCamera::z_of(double position_m) const {
  return space_.y ? static_cast<float>((space_.y->middle_m() - position_m) * units_per_m_) : 0.0F;
}

glm::vec2 WallCamera::pixel_of(glm::vec3 point) const {
  const glm::dvec4 clip = exact_ * glm::dvec4(point, 1.0);
  const glm::dvec2 device = glm::dvec2(clip) / clip.w;
  return {(0.5 + 0.5 * device.x) * size_.x, (0.5 - 0.5 * device.y) * size_.y};
}

double WallCamera::position_at(glm::vec2 pixel) const {
  // Ends of the axis in homogeneous pixels: a point between them is a weighted mean.
  const auto end = [this](double position_m) {
    const glm::dvec4 clip =
        exact_ * glm::dvec4((position_m - space_.x.middle_m()) * units_per_m_, 0.0, 0.0, 1.0);
    return glm::dvec3(0.5 * (clip.w + clip.x) * size_.x, 0.5 * (clip.w - clip.y) * size_.y, clip.w);
  };
  const glm::dvec3 from = end(space_.x.from_m);
  const glm::dvec3 to = end(space_.x.to_m);
  const glm::dvec2 from_pixel = glm::dvec2(from) / from.z;
  const glm::dvec2 along = glm::dvec2(to) / to.z - from_pixel;
  // The nearest point on the visible axis, clamped to its ends.
  const double foot = glm::dot(glm::dvec2(pixel) - from_pixel, along) / glm::dot(along, along);
  const double seen = std::clamp(foot, 0.0, 1.0);
  // Perspective: the nearer half of a line looks longer.
  const double share = seen * from.z / (seen * from.z + (1.0 - seen) * to.z);
  return space_.x.from_m + share * space_.x.length_m();
}

glm::dvec2 WallCamera::place_at(glm::vec2 pixel) const {
  if (!space_.y) return {position_at(pixel), 0.0};
  // A pointer outside counts as on the edge.
  const glm::dvec2 inside = glm::clamp(glm::dvec2(pixel), glm::dvec2(0.0), size_);
  const glm::dvec2 device(2.0 * inside.x / size_.x - 1.0, 1.0 - 2.0 * inside.y / size_.y);
  const glm::dmat4 inverse = glm::inverse(exact_);
  const auto unproject = [&](double depth) {
    const glm::dvec4 point = inverse * glm::dvec4(device, depth, 1.0);
    return glm::dvec3(point) / point.w;
  };
  const glm::dvec3 near = unproject(-1.0);
  const glm::dvec3 far = unproject(1.0);
  const glm::dvec3 point = near + near.y / (near.y - far.y) * (far - near);
  const auto within = [](const AxisExtent& extent, double from_middle_m) {
    return std::clamp(extent.middle_m() + from_middle_m, extent.from_m, extent.to_m);
  };
  return {within(space_.x, point.x / units_per_m_), within(*space_.y, -point.z / units_per_m_)};
}

}  // namespace hapticwall::ui
