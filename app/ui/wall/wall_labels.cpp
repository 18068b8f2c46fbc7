#include "app/ui/wall/wall_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/ui/wall/stiffness_bar.h"
#include "app/ui/wall/wall_floor.h"
#include "app/ui/wall/wall_solids.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

constexpr float kRulerFront = 0.25F;  // place of the ruler, in front of the walls
constexpr float kTickHalf = 3.0F;     // pixels
constexpr float kMinArrow = 0.04F;    // shorter arrows have no label
constexpr float kBelowArrow = 2.8F;   // lines from above the arrow to below it
constexpr double kSameForce = 0.01;   // share of the full scale; smaller differences get one label
constexpr const char* kTruePlace = "true place";

// Draws the ruler of one axis, with as many marks as fit.
void draw_ruler(LabelPen& pen, const WallCamera& camera, Axis axis, bool two_axes) {
  const AxisExtent extent = axis == Axis::kX ? camera.space().x : *camera.space().y;
  const double step_m = grid_step_m(extent.length_m());
  const float aside =
      (two_axes ? WallMeasures::kCornerFront : WallMeasures::kWallHalfDepth) + kRulerFront;
  const auto place_of = [&](double position_m) {
    const glm::vec3 point = axis == Axis::kX
                                ? glm::vec3(camera.x_of(position_m), WallMeasures::kFloor, aside)
                                : glm::vec3(-aside, WallMeasures::kFloor, camera.z_of(position_m));
    return pen.screen(point);
  };
  const float line = ImGui::GetFontSize();
  ImVec2 last(-1e6F, -1e6F);
  const auto first = static_cast<int>(std::ceil(extent.from_m / step_m));
  const auto end = static_cast<int>(std::floor(extent.to_m / step_m)) + 1;
  for (int mark = first; mark < end; ++mark) {
    const ImVec2 place = place_of(mark * step_m);
    if (!pen.within(ImVec2(place.x, place.y + 1.5F * line))) continue;
    const draw::PixelBox tick{ImVec2(place.x, place.y - kTickHalf),
                              ImVec2(place.x, place.y + kTickHalf)};
    if (!pen.is_free(tick)) continue;
    pen.line(tick.from, tick.to, draw::Tone::kMuted);
    const std::string text = fmt::format("{:g} mm", mark * step_m * kMillimetresPerMetre);
    if (std::abs(place.x - last.x) < ImGui::CalcTextSize(text.c_str()).x + line &&
        std::abs(place.y - last.y) < 1.2F * line)
      continue;
    if (pen.write({ImVec2(place.x, place.y + 0.9F * line), draw::Tone::kMuted, text})) last = place;
  }
}

// A name and its object.
struct Name {
  ImVec2 thing;
  draw::Tone tone;
  std::string text;
};
bool is_left_of(const Name& a, const Name& b) { return a.thing.x < b.thing.x; }

// Names above the walls, from left to right. Close names are pushed apart, and to the right of the
// readout, with lines to their walls.
void draw_wall_names(LabelPen& pen, const WallPicture& picture, const WallCamera& camera) {
  const float line = ImGui::GetFontSize();
  const float top = WallMeasures::wall_top(picture);
  std::vector<Name> names;
  for (const PictureWall& wall : picture.walls) {
    const WallSlab slab = wall_slab(picture, camera, wall);
    const bool on_x = wall.axis == Axis::kX;
    const float along = picture.two_axes && on_x ? slab.along_to : slab.along_from;
    const ImVec2 foot =
        pen.screen(on_x ? glm::vec3(slab.face, top, along) : glm::vec3(along, top, -slab.face));
    const char* axis = on_x ? "x " : "y ";
    names.push_back(
        {foot, draw::Tone::kWall,
         fmt::format("{}{:.4g} mm", picture.two_axes ? axis : "",
                     wall.face_m * kMillimetresPerMetre) +
             (picture.hides_stiffness ? "" : " · " + stiffness_text(wall.stiffness_n_per_m))});
  }
  std::sort(names.begin(), names.end(), is_left_of);
  float free_from = -1e6F;
  for (const Name& name : names) {
    // A wall whose top is outside the picture has its name at the edge.
    if (!pen.within(ImVec2(name.thing.x, std::max(name.thing.y, pen.area().corner.y)))) continue;
    const float half = 0.5F * ImGui::CalcTextSize(name.text.c_str()).x;
    const float x = picture.two_axes ? name.thing.x : std::max(name.thing.x, free_from + half);
    free_from = x + half + 0.7F * line;
    const ImVec2 text(x, std::max(name.thing.y - 1.2F * line, pen.area().corner.y + 0.7F * line));
    pen.write({text, name.tone, name.text, name.thing, ImVec2(x, text.y + 0.5F * line)},
              {{}, ImVec2(half, 0.0F), ImVec2(2.0F * half, 0.0F)});
  }
}

// Writes names below their objects, pushed apart if they would overlap.
void draw_names_below(LabelPen& pen, std::vector<Name> names, float level) {
  const float gap = ImGui::GetFontSize();
  std::sort(names.begin(), names.end(), is_left_of);
  float free_from = -1e6F;
  for (const Name& name : names) {
    if (!pen.within(name.thing)) continue;
    const float half = 0.5F * ImGui::CalcTextSize(name.text.c_str()).x;
    const ImVec2 text(std::max(name.thing.x, free_from + half),
                      std::max(level, name.thing.y + 0.5F * gap));
    free_from = text.x + half + gap;
    pen.write({ImVec2(text.x, text.y + 0.5F * gap), name.tone, name.text, name.thing,
               ImVec2(text.x, text.y - 0.1F * gap)});
  }
}

// `side`: -1 left, 1 right of the object.
void draw_name_beside(LabelPen& pen, const Name& name, float side) {
  if (!pen.within(name.thing)) return;
  const float gap = 1.2F * ImGui::GetFontSize();
  const float half = 0.5F * ImGui::CalcTextSize(name.text.c_str()).x;
  pen.write({ImVec2(name.thing.x + side * (gap + half + 3.0F), name.thing.y), name.tone, name.text,
             name.thing, ImVec2(name.thing.x + side * gap, name.thing.y)});
}

std::string handle_name(const std::string& rhythm) {
  return rhythm.empty() ? "handle" : "handle · " + rhythm;
}

void draw_things_on_axis(LabelPen& pen, const WallPicture& picture, const WallCamera& camera,
                         const std::string& rhythm) {
  constexpr float kRadius = WallMeasures::kHandleRadius;
  constexpr float kNeckHalf = 0.62F * kRadius;
  constexpr float kAtRod = -0.75F;  // place of the handle's name, from the ball
  constexpr float kSleeve = kRadius - 0.5F * (WallMeasures::kSleeveFrom + WallMeasures::kSleeveTo);
  const glm::vec3 handle = ball_centre(false, camera, swept_place(picture).from_m);
  std::vector<Name> names;
  names.push_back({pen.screen(handle + glm::vec3(kAtRod, -kNeckHalf, 0.0F)), draw::Tone::kText,
                   handle_name(rhythm)});
  if (const auto deepest_m = deepest_place(picture)) {
    const glm::vec3 place = ball_centre(false, camera, *deepest_m);
    names.push_back({pen.screen(place + kRadius * glm::vec3(0.35F, -1.0F, 0.0F)),
                     draw::Tone::kAccent, kTruePlace});
  }
  if (picture.hand_m) {
    const glm::vec3 hand = ball_centre(false, camera, *picture.hand_m);
    names.push_back({pen.screen(hand + glm::vec3(kSleeve, -WallMeasures::kSleeveRadius, 0.0F)),
                     draw::Tone::kHand, "hand"});
  }
  draw_names_below(pen, std::move(names),
                   pen.screen(handle - glm::vec3(0.0F, 2.0F * kRadius, 0.0F)).y);
}

void draw_things_on_plane(LabelPen& pen, const WallPicture& picture, const WallCamera& camera,
                          const std::string& rhythm) {
  constexpr float kRadius = WallMeasures::kHandleRadius;
  const glm::vec3 rod = rod_direction(true);
  const glm::vec3 handle = ball_centre(true, camera, swept_place(picture).from_m);
  draw_name_beside(pen,
                   {pen.screen(handle + 0.92F * WallMeasures::kStylusLength * rod),
                    draw::Tone::kText, handle_name(rhythm)},
                   -1.0F);
  if (const auto deepest_m = deepest_place(picture)) {
    const glm::vec3 place = ball_centre(true, camera, *deepest_m);
    draw_name_beside(
        pen, {pen.screen(place - glm::vec3(kRadius, 0.0F, 0.0F)), draw::Tone::kAccent, kTruePlace},
        -1.0F);
  }
  if (!picture.hand_m) return;
  const glm::vec3 hand = ball_centre(true, camera, *picture.hand_m);
  const float back = 0.5F * (WallMeasures::kSleeveFrom + WallMeasures::kSleeveTo) - kRadius;
  const glm::vec3 aside(WallMeasures::kSleeveRadius, 0.0F, 0.0F);
  draw_name_beside(pen, {pen.screen(hand + back * rod + aside), draw::Tone::kHand, "hand"}, 1.0F);
}

// "4.97 N", "0.00 to 8.90 N  limit".
std::string force_text(const WallPicture& picture, const SweptForce& force) {
  const auto size = [&](glm::dvec2 n) { return picture.two_axes ? glm::length(n) : n.x; };
  const double least_n = size(force.least_n);
  const double most_n = size(force.most_n);
  const bool one = std::abs(most_n - least_n) < kSameForce * picture.full_scale_n;
  return fmt::format("{}{:.2f} N{}", one ? "" : fmt::format("{:.2f} to ", least_n), most_n,
                     picture.saturated ? "  limit" : "");
}

void draw_force(LabelPen& pen, const WallPicture& picture, const WallCamera& camera) {
  const SweptForce force = swept_force(picture);
  const glm::vec2 arrow = arrow_of(picture, force.most_n);
  if (glm::length(arrow) < kMinArrow) return;
  const glm::dvec2 place_m = swept_place(picture).to_m;
  const glm::vec3 from = picture.two_axes ? ball_centre(true, camera, place_m)
                                          : camera.point_of(place_m, WallMeasures::kArrowHeight);
  // Stands above the middle of the arrow, else below it. With two axes, stands beyond its tip,
  // because the arrow may point towards the viewer.
  const glm::vec3 along(arrow.x, 0.0F, -arrow.y);
  const glm::vec3 beside = picture.two_axes ? from + (1.0F + 0.8F / glm::length(along)) * along
                                            : from + 0.5F * along + glm::vec3(0.0F, 0.3F, 0.0F);
  ImVec2 place = pen.screen(beside);
  const float line = ImGui::GetFontSize();
  if (!picture.two_axes) place.y -= 0.5F * line;
  const draw::Tone tone = picture.saturated ? draw::Tone::kBad : draw::Tone::kForce;
  pen.write({place, tone, force_text(picture, force)}, {{}, ImVec2(0.0F, kBelowArrow * line)});
}

// Above the mark at the longest arrow.
void draw_limit(LabelPen& pen, const WallPicture& picture, const WallCamera& camera) {
  const std::optional<glm::vec3> mark = limit_mark(picture, camera);
  if (!mark) return;
  const ImVec2 place = pen.screen(*mark + glm::vec3(0.0F, WallMeasures::kLimitMark, 0.0F));
  pen.write({ImVec2(place.x, place.y - 0.7F * ImGui::GetFontSize()), draw::Tone::kMuted, "F max"});
}

void draw_hand_name(LabelPen& pen, const WallPicture& picture, const WallCamera& camera) {
  if (!picture.hand_m) return;
  const glm::vec3 hand = ball_centre(picture.two_axes, camera, *picture.hand_m);
  const ImVec2 below = pen.screen(hand - glm::vec3(0.0F, WallMeasures::kHandleRadius, 0.0F));
  pen.write({ImVec2(below.x, below.y + ImGui::GetFontSize()), draw::Tone::kHand, "hand"});
}

}  // namespace

void draw_few_wall_labels(const draw::Theme& theme, const WallPicture& picture,
                          const WallCamera& camera, const ViewArea& area) {
  LabelPen pen(theme, camera, area, {});
  draw_limit(pen, picture, camera);
  draw_wall_names(pen, picture, camera);
  draw_hand_name(pen, picture, camera);
}

void draw_wall_labels(const draw::Theme& theme, const WallPicture& picture,
                      const WallCamera& camera, const ViewArea& area,
                      std::span<const draw::PixelBox> taken, const std::string& rhythm) {
  LabelPen pen(theme, camera, area, taken);
  StiffnessBar bar(pen, picture);
  const bool with_bar = !picture.hides_stiffness && !picture.walls.empty() && bar.has_room() &&
                        pen.is_free(bar.area());
  if (with_bar) pen.take(bar.area());
  draw_force(pen, picture, camera);
  draw_wall_names(pen, picture, camera);
  if (picture.two_axes) {
    draw_things_on_plane(pen, picture, camera, rhythm);
  } else {
    draw_things_on_axis(pen, picture, camera, rhythm);
  }
  draw_ruler(pen, camera, Axis::kX, picture.two_axes);
  if (camera.space().y) draw_ruler(pen, camera, Axis::kY, picture.two_axes);
  if (with_bar) bar.draw();
}

}  // namespace hapticwall::ui
