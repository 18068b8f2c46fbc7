#include "app/ui/wall/wall_solids.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "app/ui/wall/shapes.h"

namespace hapticwall::ui {
namespace {

constexpr float kInvisible = 0.04F;  // length of an arrow
constexpr float kArrowRadius = 0.085F;
constexpr float kArrowHeadRadius = 0.24F;
constexpr float kArrowHeadLength = 0.52F;
constexpr float kArrowFlatness = 0.7F;  // shows the force's colour clearly
constexpr float kNeck = 0.62F * WallMeasures::kHandleRadius;
constexpr float kBallTone = 0.25F;  // share of the secondary text's colour in the text's colour
constexpr float kGripTone = 0.80F;
constexpr float kFaceAlpha = 0.62F;
constexpr float kSidesAlpha = 0.40F;
constexpr float kHandAlpha = 0.55F;
constexpr float kHandFlatness = 0.45F;
constexpr float kTruePlaceAlpha = 0.95F;
constexpr float kSweptAlpha = 0.45F;
constexpr float kSweptLength = 0.01F;  // shorter ones are not seen
constexpr float kEdgeWidth = 0.035F;
constexpr float kNearness = 2.5F;  // distance from the face at which the handle's shadow begins
constexpr float kFaceGrid = 0.5F;

draw::GlMesh mesh_of(const Shape& shape) { return {shape.vertices, shape.indices}; }

// Rotation from a wall's own directions to the picture's.
glm::mat4 frame_of(Axis axis) {
  if (axis == Axis::kX) return glm::mat4(1.0F);
  return glm::rotate(glm::mat4(1.0F), glm::radians(90.0F), {0.0F, 1.0F, 0.0F});
}

glm::vec4 own_colour(const WallPicture& picture, const draw::Theme& theme,
                     const PictureWall& wall) {
  return rgba(stiffness_colour(theme, stiffness_scale(picture).share(wall.stiffness_n_per_m)));
}

// The colours of the handle come from the text's, because the eye follows it.
glm::vec4 handle_colour(const draw::Theme& theme, float share) {
  return rgba(
      draw::mixed(theme.colour(draw::Tone::kText), theme.colour(draw::Tone::kMuted), share));
}

}  // namespace

glm::vec3 ball_centre(bool two_axes, const WallCamera& camera, glm::dvec2 place_m) {
  constexpr float kRadius = WallMeasures::kHandleRadius;
  const glm::vec3 tip = camera.point_of(place_m);
  return {tip.x - kRadius, 0.0F, two_axes ? tip.z + kRadius : 0.0F};
}

glm::vec3 rod_direction(bool two_axes) {
  return two_axes ? glm::normalize(glm::vec3(-0.30F, 1.0F, 0.36F)) : glm::vec3(-1.0F, 0.0F, 0.0F);
}

std::optional<glm::vec3> limit_mark(const WallPicture& picture, const WallCamera& camera) {
  if (picture.two_axes || !picture.has_limit) return std::nullopt;
  const glm::vec3 start = camera.point_of(swept_place(picture).to_m, WallMeasures::kArrowHeight);
  return start - glm::vec3(WallMeasures::kMaxArrow, 0.0F, 0.0F);
}

WallSlab wall_slab(const WallPicture& picture, const WallCamera& camera, const PictureWall& wall) {
  const bool on_x = wall.axis == Axis::kX;
  const auto into = [&](double position_m) {
    return on_x ? camera.x_of(position_m) : -camera.z_of(position_m);
  };
  WallSlab slab;
  slab.wall = &wall;
  slab.face = into(wall.face_m);
  slab.end = WallMeasures::kFarEnd;
  for (const PictureWall& other : picture.walls) {
    if (other.axis == wall.axis && other.face_m > wall.face_m)
      slab.end = std::min(slab.end, into(other.face_m));
  }
  slab.along_from = on_x && !picture.two_axes ? -WallMeasures::kWallHalfDepth
                    : on_x                    ? -WallMeasures::kFarEnd
                                              : -WallMeasures::kCornerFront;
  slab.along_to = picture.two_axes ? WallMeasures::kCornerFront : WallMeasures::kWallHalfDepth;
  if (!on_x) {
    // The walls on x reach to the back; those on y end at them.
    const PictureWall* corner = outermost_wall(picture, Axis::kX);
    slab.along_to = corner != nullptr ? camera.x_of(corner->face_m) : WallMeasures::kFarEnd;
  }
  const glm::dvec2 tip_m = swept_place(picture).to_m;
  const glm::vec3 ball = ball_centre(picture.two_axes, camera, tip_m);
  slab.tip = into(tip_m[index_of(wall.axis)]);
  slab.tip_along = on_x ? ball.z : ball.x;
  return slab;
}

std::vector<WallSlab> wall_slabs(const WallPicture& picture, const WallCamera& camera) {
  std::vector<WallSlab> slabs;
  for (const PictureWall& wall : picture.walls) {
    const WallSlab slab = wall_slab(picture, camera, wall);
    if (slab.end > slab.face) slabs.push_back(slab);
  }
  const glm::vec3& eye = camera.eye();
  const PictureWall* corner = outermost_wall(picture, Axis::kX);
  const bool x_is_behind = corner != nullptr && eye.x < camera.x_of(corner->face_m);
  std::sort(slabs.begin(), slabs.end(), [&](const WallSlab& a, const WallSlab& b) {
    if (a.wall->axis != b.wall->axis) return (a.wall->axis == Axis::kX) == x_is_behind;
    const float here = a.wall->axis == Axis::kX ? eye.x : -eye.z;
    return std::abs(0.5F * (a.face + a.end) - here) > std::abs(0.5F * (b.face + b.end) - here);
  });
  return slabs;
}

WallSolids::WallSolids(draw::GlProgram solid, draw::GlProgram wall)
    : solid_(std::move(solid)),
      wall_(std::move(wall)),
      box_(mesh_of(make_box())),
      sphere_(mesh_of(make_sphere())),
      cylinder_(mesh_of(make_cylinder())),
      cone_(mesh_of(make_cone())),
      face_(mesh_of(make_face())),
      sides_(mesh_of(make_sides())) {}

Result<WallSolids> WallSolids::create() {
  Result<draw::GlProgram> solid = draw::GlProgram::create("solid.vert", "solid.frag");
  if (!solid) return solid.error();
  Result<draw::GlProgram> wall = draw::GlProgram::create("wall.vert", "wall.frag");
  if (!wall) return wall.error();
  return WallSolids(std::move(*solid), std::move(*wall));
}

void WallSolids::part(const draw::GlMesh& mesh, const glm::mat4& model,
                      const glm::vec4& colour) const {
  solid_.set("model", model);
  solid_.set("normal_matrix", glm::inverseTranspose(glm::mat3(model)));
  solid_.set("colour", colour);
  mesh.draw();
}

// The mesh lies along x from 0 to 1.
void WallSolids::rod(const draw::GlMesh& mesh, glm::vec3 from, glm::vec3 to, float radius,
                     const glm::vec4& colour) const {
  const glm::vec3 along = to - from;
  const glm::vec3 x = glm::normalize(along);
  const glm::vec3 aside = std::abs(x.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1);
  const glm::vec3 z = glm::normalize(glm::cross(x, aside));
  const glm::mat4 model(glm::vec4(along, 0.0F), glm::vec4(radius * glm::cross(z, x), 0.0F),
                        glm::vec4(radius * z, 0.0F), glm::vec4(from, 1.0F));
  part(mesh, model, colour);
}

void WallSolids::ball(glm::vec3 centre, float radius, const glm::vec4& colour) const {
  part(sphere_, glm::scale(glm::translate(glm::mat4(1.0F), centre), glm::vec3(radius)), colour);
}

void WallSolids::surface(float shininess, float flatness, float shell) const {
  solid_.set("shininess", shininess);
  solid_.set("flatness", flatness);
  solid_.set("shell", shell);
}

// Draws the handle at the free end of its way.
void WallSolids::draw_handle(const WallView& view) const {
  const auto& [picture, camera, theme] = view;
  const glm::vec3 centre = ball_centre(picture.two_axes, camera, swept_place(picture).from_m);
  const float length = picture.two_axes ? WallMeasures::kStylusLength
                                        : WallMeasures::kHandleLength - WallMeasures::kHandleRadius;
  const glm::vec3 end = centre + length * rod_direction(picture.two_axes);
  const glm::vec4 grip = handle_colour(theme, kGripTone);
  surface(1.0F, 0.0F, 0.0F);
  ball(centre, WallMeasures::kHandleRadius, handle_colour(theme, kBallTone));
  rod(cylinder_, centre, end, kNeck, grip);
  ball(end, kNeck, grip);
}

// The rest of its way.
void WallSolids::draw_swept_handle(const WallView& view) const {
  const auto& [picture, camera, theme] = view;
  const SweptPlace swept = swept_place(picture);
  const glm::vec3 from = ball_centre(picture.two_axes, camera, swept.from_m);
  const glm::vec3 to = ball_centre(picture.two_axes, camera, swept.to_m);
  if (glm::distance(from, to) < kSweptLength) return;
  glm::vec4 colour = handle_colour(theme, kBallTone);
  colour.a = kSweptAlpha;
  surface(1.0F, 0.0F, 0.0F);
  rod(cylinder_, from, to, WallMeasures::kHandleRadius, colour);
  ball(to, WallMeasures::kHandleRadius, colour);
}

// A sleeve around the handle's rod where the hand would hold it, and the tip at the hand's intended
// position.
void WallSolids::draw_hand(const WallView& view) const {
  const auto& [picture, camera, theme] = view;
  if (!picture.hand_m) return;
  const glm::vec3 centre = ball_centre(picture.two_axes, camera, *picture.hand_m);
  const glm::vec3 direction = rod_direction(picture.two_axes);
  const float from = WallMeasures::kSleeveFrom - WallMeasures::kHandleRadius;
  const float to = WallMeasures::kSleeveTo - WallMeasures::kHandleRadius;
  const glm::vec4 colour = rgba(draw::with_alpha(theme.colour(draw::Tone::kHand), kHandAlpha));
  surface(0.3F, kHandFlatness, 0.0F);
  rod(cylinder_, centre + from * direction, centre + to * direction, WallMeasures::kSleeveRadius,
      colour);
  surface(0.0F, 1.0F, 1.0F);
  ball(centre, WallMeasures::kHandleRadius, rgba(theme.colour(draw::Tone::kHand)));
}

void WallSolids::draw_true_place(const WallView& view) const {
  const auto& [picture, camera, theme] = view;
  const std::optional<glm::dvec2> deepest_m = deepest_place(picture);
  if (!deepest_m) return;
  surface(0.0F, 1.0F, 1.0F);
  ball(ball_centre(picture.two_axes, camera, *deepest_m), WallMeasures::kHandleRadius,
       rgba(draw::with_alpha(theme.colour(draw::Tone::kAccent), kTruePlaceAlpha)));
}

void WallSolids::draw_arrow(const WallView& view, glm::dvec2 force_n, float alpha) const {
  const auto& [picture, camera, theme] = view;
  const glm::vec2 arrow = arrow_of(picture, force_n);
  const float length = glm::length(arrow);
  if (length < kInvisible) return;
  const glm::vec3 direction = glm::vec3(arrow.x, 0.0F, -arrow.y) / length;
  const glm::dvec2 place_m = swept_place(picture).to_m;
  const glm::vec3 start = picture.two_axes ? ball_centre(true, camera, place_m) +
                                                 WallMeasures::kHandleRadius * direction
                                           : camera.point_of(place_m, WallMeasures::kArrowHeight);
  // A short arrow is all head.
  const float head = std::min(kArrowHeadLength, length);
  const glm::vec3 neck = start + (length - head) * direction;
  const glm::vec4 colour = rgba(draw::with_alpha(
      theme.colour(picture.saturated ? draw::Tone::kBad : draw::Tone::kForce), alpha));
  surface(0.3F, kArrowFlatness, 0.0F);
  if (length > head) rod(cylinder_, start, neck, kArrowRadius, colour);
  rod(cone_, neck, neck + head * direction, kArrowHeadRadius * head / kArrowHeadLength, colour);
}

// The rest of the arrow's way as one surface: only its nearest layer is drawn.
void WallSolids::draw_swept_arrow(const WallView& view) const {
  const SweptForce force = swept_force(view.picture);
  if (force.most_n == force.least_n) return;
  glDepthMask(GL_TRUE);
  draw_arrow(view, force.most_n, kSweptAlpha);
  glDepthMask(GL_FALSE);
}

// An upright bar where the arrow ends at the force limit.
void WallSolids::draw_limit(const WallView& view) const {
  const std::optional<glm::vec3> mark = limit_mark(view.picture, view.camera);
  if (!mark) return;
  const glm::vec3 up(0.0F, WallMeasures::kLimitMark, 0.0F);
  surface(0.0F, 1.0F, 0.0F);
  rod(cylinder_, *mark - up, *mark + up, 0.5F * kEdgeWidth,
      rgba(view.theme.colour(draw::Tone::kMuted)));
}

void WallSolids::draw_edges(const WallPicture& picture, const WallSlab& slab,
                            const glm::vec4& colour) const {
  const float top = WallMeasures::wall_top(picture);
  const float height = top - WallMeasures::kFloor;
  const float length = slab.along_to - slab.along_from;
  const glm::mat4 frame = frame_of(slab.wall->axis);
  const auto beam = [&](glm::vec3 middle, glm::vec3 size) {
    part(box_, frame * glm::scale(glm::translate(glm::mat4(1.0F), middle), size), colour);
  };
  for (const float side : {slab.along_from, slab.along_to})
    beam({slab.face, WallMeasures::kFloor + 0.5F * height, side}, {kEdgeWidth, height, kEdgeWidth});
  for (const float level : {WallMeasures::kFloor, top})
    beam({slab.face, level, 0.5F * (slab.along_from + slab.along_to)},
         {kEdgeWidth, kEdgeWidth, length});
}

// draw_walls() draws the transparent sides after it.
void WallSolids::draw_slab(const WallPicture& picture, const WallSlab& slab) const {
  const float height = WallMeasures::wall_top(picture) - WallMeasures::kFloor;
  wall_.set("frame", frame_of(slab.wall->axis));
  wall_.set("origin", glm::vec3(slab.face, WallMeasures::kFloor + 0.5F * height,
                                0.5F * (slab.along_from + slab.along_to)));
  wall_.set("size", glm::vec3(slab.end - slab.face, height, slab.along_to - slab.along_from));
  wall_.set("grid_step", kFaceGrid);
  glDisable(GL_CULL_FACE);
  face_.draw();
  glEnable(GL_CULL_FACE);
}

// Transparent, so drawn after all that may be inside; the handle stays visible there.
void WallSolids::draw_walls(const WallView& view, const std::vector<WallSlab>& slabs) const {
  const auto& [picture, camera, theme] = view;
  const StiffnessScale scale = stiffness_scale(picture);
  wall_.use();
  wall_.set("view_projection", camera.view_projection());
  wall_.set("eye", camera.eye());
  for (const WallSlab& slab : slabs) {
    const ShownStiffness& shown = picture.shown.at(static_cast<std::size_t>(slab.wall->axis));
    const glm::vec4 own = own_colour(picture, theme, *slab.wall);
    const float nearness = 1.0F - std::clamp((slab.face - slab.tip) / kNearness, 0.0F, 1.0F);
    const glm::vec4 touched(std::max(slab.tip, slab.face), 0.0F, slab.tip_along, 1.0F);
    wall_.set("shown", rgba(draw::with_alpha(stiffness_colour(theme, scale.share(shown.n_per_m)),
                                             static_cast<float>(shown.strength))));
    wall_.set("contact", glm::vec4(glm::vec3(frame_of(slab.wall->axis) * touched), nearness));
    wall_.set("colour", glm::vec4(glm::vec3(own), kFaceAlpha));
    draw_slab(picture, slab);
    wall_.set("colour", glm::vec4(glm::vec3(own), kSidesAlpha));
    wall_.set("grid_step", 0.0F);
    sides_.draw();
  }
}

void WallSolids::draw(const WallView& view) const {
  const auto& [picture, camera, theme] = view;
  const std::vector<WallSlab> slabs = wall_slabs(picture, camera);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  solid_.use();
  solid_.set("view_projection", camera.view_projection());
  solid_.set("eye", camera.eye());
  const SweptForce force = swept_force(picture);
  draw_handle(view);
  draw_arrow(view, force.least_n, 1.0F);
  draw_limit(view);
  surface(0.2F, 0.3F, 0.0F);
  for (const WallSlab& slab : slabs) {
    const bool tells = picture.verdict && slab.wall->axis == Axis::kX;
    draw_edges(
        picture, slab,
        tells ? rgba(theme.colour(*picture.verdict)) : own_colour(picture, theme, *slab.wall));
  }
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  draw_walls(view, slabs);
  // True place and intended hand are drawn over the walls; only the handle hides them.
  solid_.use();
  draw_swept_handle(view);
  draw_swept_arrow(view);
  draw_true_place(view);
  draw_hand(view);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
}

}  // namespace hapticwall::ui
