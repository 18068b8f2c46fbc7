#include "app/ui/wall/wall_floor.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "app/ui/wall/shapes.h"
#include "app/ui/wall/wall_solids.h"

namespace hapticwall::ui {
namespace {

constexpr float kFloorSize = 40.0F;
constexpr double kGridLines = 6.0;  // minimum on an extent
constexpr float kDarkness = 0.85F;  // darkness of shadows, in a dark theme
constexpr float kLightness = 0.5F;  // threshold of a light theme
constexpr float kDarknessInLight = 0.50F;
constexpr float kFloorTone = 0.045F;  // share of the text colour in the floor
constexpr float kGridTone = 0.32F;
const glm::vec2 kShadowShift(0.10F, -0.14F);  // away from the key light

float darkness(const draw::Theme& theme) {
  const ImVec4& panel = theme.colour(draw::Tone::kPanel);
  const float brightness = (panel.x + panel.y + panel.z) / 3.0F;
  return brightness > kLightness ? kDarknessInLight : kDarkness;
}

}  // namespace

double grid_step_m(double length_m) {
  const double largest = length_m / kGridLines;
  const double power = std::pow(10.0, std::floor(std::log10(largest)));
  for (const double step : {5.0, 2.0}) {
    if (step * power <= largest) return step * power;
  }
  return power;
}

std::optional<glm::vec4> wall_block(const WallPicture& picture, const WallCamera& camera,
                                    Axis axis) {
  const PictureWall* wall = outermost_wall(picture, axis);
  if (wall == nullptr) return std::nullopt;
  const WallSlab slab = wall_slab(picture, camera, *wall);
  const float end = std::max(slab.face, WallMeasures::kFarEnd);
  if (axis == Axis::kX) return glm::vec4(slab.face, end, slab.along_from, slab.along_to);
  return glm::vec4(slab.along_from, slab.along_to, -end, -slab.face);
}

WallFloor::WallFloor(draw::GlProgram backdrop, draw::GlProgram floor, draw::GlProgram shadow)
    : backdrop_(std::move(backdrop)), floor_(std::move(floor)), shadow_(std::move(shadow)) {
  const Shape plane = make_plane();
  plane_ = draw::GlMesh(plane.vertices, plane.indices);
}

Result<WallFloor> WallFloor::create() {
  Result<draw::GlProgram> backdrop = draw::GlProgram::create("solid.vert", "backdrop.frag");
  if (!backdrop) return backdrop.error();
  Result<draw::GlProgram> floor = draw::GlProgram::create("solid.vert", "floor.frag");
  if (!floor) return floor.error();
  Result<draw::GlProgram> shadow = draw::GlProgram::create("solid.vert", "shadow.frag");
  if (!shadow) return shadow.error();
  return WallFloor(std::move(*backdrop), std::move(*floor), std::move(*shadow));
}

// The plane, transparent.
void WallFloor::draw_blended() const {
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  plane_.draw();
  glDisable(GL_BLEND);
}

void WallFloor::draw_backdrop(const WallView& view, int height) const {
  const draw::Theme& theme = view.theme;
  const glm::mat4& view_projection = view.camera.view_projection();
  backdrop_.use();
  // A plane that fills the picture and faces the eye.
  const glm::mat4 upright = glm::scale(
      glm::rotate(glm::mat4(1.0F), glm::radians(90.0F), {1.0F, 0.0F, 0.0F}), glm::vec3(2.0F));
  backdrop_.set("view_projection", view_projection);
  backdrop_.set("model", glm::inverse(view_projection) * upright);
  backdrop_.set("normal_matrix", glm::mat3(1.0F));
  backdrop_.set("lower", rgba(theme.colour(draw::Tone::kPanel)));
  backdrop_.set("upper", rgba(draw::mixed(theme.colour(draw::Tone::kPanel),
                                          theme.colour(draw::Tone::kBackground), 0.6F)));
  backdrop_.set("height", static_cast<float>(height));
  plane_.draw();
}

void WallFloor::draw(const WallView& view, int height) const {
  const auto& [picture, camera, theme] = view;
  draw_backdrop(view, height);
  floor_.use();
  floor_.set("view_projection", camera.view_projection());
  floor_.set("model",
             glm::scale(glm::translate(glm::mat4(1.0F), {0.0F, WallMeasures::kFloor, 0.0F}),
                        glm::vec3(kFloorSize)));
  floor_.set("normal_matrix", glm::mat3(1.0F));
  floor_.set("colour", rgba(draw::mixed(theme.colour(draw::Tone::kPanel),
                                        theme.colour(draw::Tone::kText), kFloorTone)));
  floor_.set("line_colour", rgba(draw::with_alpha(theme.colour(draw::Tone::kMuted), kGridTone)));
  floor_.set("grid_origin", glm::vec2(camera.x_of(0.0), camera.z_of(0.0)));
  floor_.set("grid_step",
             static_cast<float>(grid_step_m(camera.space().x.length_m()) * camera.units_per_m()));
  const glm::vec4 none(0.0F);
  floor_.set("block_x", wall_block(picture, camera, Axis::kX).value_or(none));
  floor_.set("block_y", wall_block(picture, camera, Axis::kY).value_or(none));
  floor_.set("darkness", darkness(theme));
  draw_blended();
}

void WallFloor::draw_shadow(const WallView& view) const {
  const auto& [picture, camera, theme] = view;
  constexpr float kRadius = WallMeasures::kHandleRadius;
  constexpr float kReach = 2.3F * kRadius;  // same value as in the shader
  const glm::vec3 ball = ball_centre(picture.two_axes, camera, swept_place(picture).from_m);
  const float length = picture.two_axes ? 0.0F : WallMeasures::kHandleLength - kRadius;
  const glm::vec2 middle = glm::vec2(ball.x - 0.5F * length, ball.z) + kShadowShift;
  shadow_.use();
  shadow_.set("view_projection", camera.view_projection());
  shadow_.set("model", glm::scale(glm::translate(glm::mat4(1.0F),
                                                 {middle.x, WallMeasures::kFloor, middle.y}),
                                  {length + 2.0F * kReach, 1.0F, 2.0F * kReach}));
  shadow_.set("normal_matrix", glm::mat3(1.0F));
  shadow_.set("shadow",
              glm::vec4(middle.x - 0.5F * length, middle.x + 0.5F * length, middle.y, kRadius));
  shadow_.set("darkness", darkness(theme));
  draw_blended();
}

}  // namespace hapticwall::ui
