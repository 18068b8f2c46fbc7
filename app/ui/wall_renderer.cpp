#include "app/ui/wall_renderer.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "app/ui/shapes.h"

namespace hapticwall::ui {
namespace {

constexpr int kSamplesPerPixel = 4;
constexpr double kGridStepM = 0.01;
constexpr double kDefaultFullScaleN = 10.0;  // where the device has no force limit
constexpr float kInvisibleArrow = 0.04F;
constexpr float kArrowRadius = 0.085F;
constexpr float kArrowHeadRadius = 0.24F;
constexpr float kArrowHeadLength = 0.52F;
constexpr float kWallAlpha = 0.62F;
constexpr float kGhostAlpha = 0.45F;
constexpr float kGhostFlatness = 0.5F;
constexpr float kArrowFlatness = 0.7F;  // the force's colour is to be recognised at once
constexpr float kFarEnd = 0.5F * WallCamera::kLength + 1.2F;  // of the last wall
const glm::vec4 kHandleColour(0.80F, 0.84F, 0.88F, 1.0F);
const glm::vec4 kGripColour(0.30F, 0.34F, 0.40F, 1.0F);

glm::vec4 vector_of(const ImVec4& colour, float alpha = 1.0F) {
  return {colour.x, colour.y, colour.z, alpha};
}

class Renderer final : public WallRenderer {
 public:
  Renderer(GlProgram solid, GlProgram floor)
      : solid_(std::move(solid)),
        floor_(std::move(floor)),
        box_(mesh(make_box())),
        sphere_(mesh(make_sphere())),
        cylinder_(mesh(make_cylinder())),
        cone_(mesh(make_cone())) {}

  GLuint draw(const WallPicture& picture, const WallCamera& camera, const Theme& theme, int width,
              int height) override;
  [[nodiscard]] GLuint framebuffer() const override {
    return target_ ? target_->resolved_framebuffer() : 0;
  }

 private:
  static GlMesh mesh(const Shape& shape) { return {shape.vertices, shape.indices}; }
  bool ensure_target(int width, int height);
  void part(const GlMesh& mesh, glm::vec3 position, glm::vec3 size, glm::vec4 colour) const;
  void draw_floor(const WallPicture& picture, const WallCamera& camera, const Theme& theme) const;
  void draw_handle(float tip, glm::vec4 ball, glm::vec4 grip) const;
  void draw_arrow(const WallPicture& picture, float tip, glm::vec4 colour) const;
  void draw_walls(const WallPicture& picture, const WallCamera& camera, const Theme& theme) const;
  void draw_face_edges(float face, glm::vec4 colour) const;

  GlProgram solid_;
  GlProgram floor_;
  GlMesh box_;
  GlMesh sphere_;
  GlMesh cylinder_;
  GlMesh cone_;
  std::optional<GlTarget> target_;
};

bool Renderer::ensure_target(int width, int height) {
  if (target_ && target_->width() == width && target_->height() == height) return true;
  target_.reset();
  Result<GlTarget> created = GlTarget::create(width, height, kSamplesPerPixel);
  if (created) target_ = std::move(*created);
  return created.ok();
}

void Renderer::part(const GlMesh& mesh, glm::vec3 position, glm::vec3 size,
                    glm::vec4 colour) const {
  solid_.set("model", glm::scale(glm::translate(glm::mat4(1.0F), position), size));
  solid_.set("colour", colour);
  mesh.draw();
}

void Renderer::draw_floor(const WallPicture& picture, const WallCamera& camera,
                          const Theme& theme) const {
  constexpr float kFloorSize = 60.0F;
  const float tip = camera.x_of(picture.handle_m);
  floor_.use();
  floor_.set("view_projection", camera.view_projection());
  floor_.set("model", glm::scale(glm::translate(glm::mat4(1.0F),
                                                {0.0F, WallMeasures::kFloor - 0.005F, 0.0F}),
                                 {kFloorSize, 0.01F, kFloorSize}));
  floor_.set("colour", vector_of(theme.colour(Tone::kPanel)) * 1.15F);
  floor_.set("line_colour", vector_of(theme.colour(Tone::kMuted)));
  floor_.set("backdrop", vector_of(theme.colour(Tone::kPanel)));
  floor_.set("grid_origin", camera.x_of(0.0));
  floor_.set("grid_step", static_cast<float>(kGridStepM * camera.units_per_m()));
  floor_.set("shadow",
             glm::vec4(tip - WallMeasures::kHandleLength, tip - WallMeasures::kHandleRadius,
                       WallMeasures::kHandleRadius, 0.55F));
  box_.draw();
}

void Renderer::draw_handle(float tip, glm::vec4 ball, glm::vec4 grip) const {
  constexpr float kRadius = WallMeasures::kHandleRadius;
  constexpr float kNeck = 0.62F * kRadius;
  const float centre = tip - kRadius;
  const float end = tip - WallMeasures::kHandleLength;
  part(sphere_, {centre, 0.0F, 0.0F}, glm::vec3(kRadius), ball);
  part(cylinder_, {end, 0.0F, 0.0F}, {centre - end, kNeck, kNeck}, grip);
  part(sphere_, {end, 0.0F, 0.0F}, glm::vec3(kNeck), grip);
}

void Renderer::draw_arrow(const WallPicture& picture, float tip, glm::vec4 colour) const {
  const float length = arrow_length(picture);
  if (std::abs(length) < kInvisibleArrow) return;
  const float direction = length < 0.0F ? -1.0F : 1.0F;
  // A short arrow is all head.
  const float head = std::min(kArrowHeadLength, std::abs(length));
  const float thickness = head / kArrowHeadLength;
  const float shaft = std::abs(length) - head;
  const glm::mat4 frame =
      glm::scale(glm::translate(glm::mat4(1.0F), {tip, WallMeasures::kArrowHeight, 0.0F}),
                 {direction, 1.0F, 1.0F});
  const auto draw_part = [&](const GlMesh& mesh, float from, float along, float radius) {
    solid_.set("model",
               glm::scale(glm::translate(frame, {from, 0.0F, 0.0F}), {along, radius, radius}));
    solid_.set("colour", colour);
    mesh.draw();
  };
  // Mirroring turns the front of every triangle to the back.
  glFrontFace(direction < 0.0F ? GL_CW : GL_CCW);
  if (shaft > 0.0F) draw_part(cylinder_, 0.0F, shaft, kArrowRadius);
  draw_part(cone_, shaft, head, kArrowHeadRadius * thickness);
  glFrontFace(GL_CCW);
}

void Renderer::draw_face_edges(float face, glm::vec4 colour) const {
  constexpr float kEdge = 0.035F;
  constexpr float kHeight = WallMeasures::kWallTop - WallMeasures::kFloor;
  constexpr float kMiddle = 0.5F * (WallMeasures::kWallTop + WallMeasures::kFloor);
  constexpr float kDepth = WallMeasures::kWallHalfDepth;
  for (const float side : {-kDepth, kDepth}) {
    part(box_, {face, kMiddle, side}, {kEdge, kHeight, kEdge}, colour);
  }
  for (const float level : {WallMeasures::kFloor, WallMeasures::kWallTop}) {
    part(box_, {face, level, 0.0F}, {kEdge, kEdge, 2.0F * kDepth}, colour);
  }
}

// Transparent, so drawn last and the deepest first; the handle stays visible inside.
void Renderer::draw_walls(const WallPicture& picture, const WallCamera& camera,
                          const Theme& theme) const {
  constexpr float kHeight = WallMeasures::kWallTop - WallMeasures::kFloor;
  constexpr float kMiddle = 0.5F * (WallMeasures::kWallTop + WallMeasures::kFloor);
  const glm::vec4 colour = vector_of(theme.colour(Tone::kWall));
  float end = kFarEnd;
  for (auto face_m = picture.wall_faces_m.rbegin(); face_m != picture.wall_faces_m.rend();
       ++face_m) {
    const float face = camera.x_of(*face_m);
    draw_face_edges(face, colour * 1.15F);
    if (end > face) {
      part(box_, {0.5F * (face + end), kMiddle, 0.0F},
           {end - face, kHeight, 2.0F * WallMeasures::kWallHalfDepth},
           glm::vec4(glm::vec3(colour) * 0.72F, kWallAlpha));
    }
    end = face;
  }
}

GLuint Renderer::draw(const WallPicture& picture, const WallCamera& camera, const Theme& theme,
                      int width, int height) {
  if (!ensure_target(width, height)) return 0;
  target_->bind();
  const ImVec4 backdrop = theme.colour(Tone::kPanel);
  glClearColor(backdrop.x, backdrop.y, backdrop.z, 1.0F);
  glDisable(GL_SCISSOR_TEST);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  draw_floor(picture, camera, theme);

  const float tip = camera.x_of(picture.handle_m);
  const glm::vec4 force_colour =
      vector_of(theme.colour(picture.saturated ? Tone::kBad : Tone::kForce));
  solid_.use();
  solid_.set("view_projection", camera.view_projection());
  solid_.set("eye", camera.eye());
  solid_.set("shininess", 1.0F);
  solid_.set("flatness", 0.0F);
  solid_.set("glow", glm::vec4(0.0F));
  solid_.set("glow_colour", force_colour);
  draw_handle(tip, kHandleColour, kGripColour);
  solid_.set("shininess", 0.3F);
  solid_.set("flatness", kArrowFlatness);
  draw_arrow(picture, tip, force_colour);
  solid_.set("flatness", 0.0F);

  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  const float strength = picture.in_contact ? 0.85F : 0.0F;
  solid_.set("shininess", 0.15F);
  const float face =
      picture.wall_faces_m.empty() ? 0.0F : camera.x_of(picture.wall_faces_m.front());
  solid_.set("glow", glm::vec4(face, 0.0F, 0.0F, strength));
  draw_walls(picture, camera, theme);
  if (picture.hand_m) {
    // Over the walls, as it is only an intention; the handle itself hides it.
    solid_.set("glow", glm::vec4(0.0F));
    const glm::vec4 ghost = vector_of(theme.colour(Tone::kHand), kGhostAlpha);
    solid_.set("flatness", kGhostFlatness);
    draw_handle(camera.x_of(*picture.hand_m), ghost, ghost);
  }
  glDepthMask(GL_TRUE);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  target_->resolve();
  return target_->texture();
}

}  // namespace

WallPicture wall_picture(const Scene& scene, const Sample& sample) {
  WallPicture picture;
  picture.handle_m = sample.truth.position_m;
  if (scene.hand) picture.hand_m = sample.truth.hand_path_m;
  for (const WallSettings& wall : scene.walls) picture.wall_faces_m.push_back(wall.position_m);
  std::sort(picture.wall_faces_m.begin(), picture.wall_faces_m.end());
  picture.force_n = sample.force_n;
  picture.full_scale_n = scene.device.force_limit_n.value_or(kDefaultFullScaleN);
  picture.saturated = (sample.flags & kFlagForceLimit) != 0U;
  picture.in_contact = (sample.flags & kFlagInContact) != 0U;
  return picture;
}

float arrow_length(const WallPicture& picture) {
  const double share =
      std::clamp(picture.force_n / std::max(picture.full_scale_n, 1e-9), -1.0, 1.0);
  return -WallMeasures::kLongestArrow * static_cast<float>(share);
}

Result<std::unique_ptr<WallRenderer>> WallRenderer::create() {
  Result<GlProgram> solid = GlProgram::create("solid.vert", "solid.frag");
  if (!solid) return solid.error();
  Result<GlProgram> floor = GlProgram::create("solid.vert", "floor.frag");
  if (!floor) return floor.error();
  return std::unique_ptr<WallRenderer>(
      std::make_unique<Renderer>(std::move(*solid), std::move(*floor)));
}

}  // namespace hapticwall::ui
