#include "app/ui/wall/wall_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/ui/wall/wall_floor.h"
#include "app/ui/wall/wall_solids.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

constexpr float kRulerFront = 0.25F;  // of the ruler, in front of the walls
constexpr float kMinArrow = 0.04F;    // shorter arrows have no label
constexpr float kEdge = 4.0F;         // pixels that are kept free
constexpr double kSameForce = 0.01;   // of the full scale: what the label does not tell apart
constexpr const char* kTruePlace = "true place";

// Places in the picture's units become pixels of the window.
class Pen {
 public:
  Pen(const draw::Theme& theme, const WallCamera& camera, const ViewArea& area)
      : theme_(theme), camera_(camera), area_(area), list_(ImGui::GetWindowDrawList()) {}

  [[nodiscard]] ImVec2 screen(glm::vec3 point) const {
    const glm::vec2 pixel = camera_.pixel_of(point);
    return {area_.corner.x + pixel.x, area_.corner.y + pixel.y};
  }
  [[nodiscard]] bool within(ImVec2 place) const {
    return place.x >= area_.corner.x && place.x <= area_.corner.x + area_.size.x &&
           place.y >= area_.corner.y && place.y <= area_.corner.y + area_.size.y;
  }
  // Reserves the area right of and below this place.
  void cover_from(ImVec2 place) { covered_ = place; }
  [[nodiscard]] bool is_covered(ImVec2 place) const {
    return place.x > covered_.x && place.y > covered_.y;
  }
  // Centred at `place`, kept inside the picture.
  void write(ImVec2 place, draw::Tone tone, const std::string& text) const {
    const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
    const float x = kept(place.x - 0.5F * extent.x, area_.corner.x, area_.size.x - extent.x);
    const float y = kept(place.y - 0.5F * extent.y, area_.corner.y, area_.size.y - extent.y);
    list_->AddRectFilled(ImVec2(x - 2.0F, y), ImVec2(x + extent.x + 2.0F, y + extent.y),
                         theme_.packed(draw::Tone::kPanel, kBehindText), 3.0F);
    list_->AddText(ImVec2(x, y), theme_.packed(tone), text.c_str());
  }
  void line(ImVec2 from, ImVec2 to, draw::Tone tone, float alpha = 1.0F) const {
    list_->AddLine(from, to, theme_.packed(tone, alpha), 1.0F);
  }
  [[nodiscard]] const draw::Theme& theme() const { return theme_; }
  [[nodiscard]] ImDrawList* list() const { return list_; }
  [[nodiscard]] const ViewArea& area() const { return area_; }

 private:
  static float kept(float from, float edge, float room) {
    return std::clamp(from, edge + kEdge, std::max(edge + kEdge, edge + room - kEdge));
  }
  const draw::Theme& theme_;
  const WallCamera& camera_;
  const ViewArea& area_;
  ImDrawList* list_;
  ImVec2 covered_{1e6F, 1e6F};
};

// Draws the ruler of one axis, with as many marks as fit.
void draw_ruler(const Pen& pen, const WallCamera& camera, Axis axis, bool two_axes) {
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
    if (pen.is_covered(ImVec2(place.x + 2.0F * line, place.y + line))) continue;
    pen.line(ImVec2(place.x, place.y - 3.0F), ImVec2(place.x, place.y + 3.0F), draw::Tone::kMuted);
    const std::string text = fmt::format("{:g} mm", mark * step_m * kMillimetresPerMetre);
    if (std::abs(place.x - last.x) < ImGui::CalcTextSize(text.c_str()).x + line &&
        std::abs(place.y - last.y) < 1.2F * line)
      continue;
    pen.write(ImVec2(place.x, place.y + 0.9F * line), draw::Tone::kMuted, text);
    last = place;
  }
}

// A name and its object.
struct Name {
  ImVec2 thing;
  draw::Tone tone;
  std::string text;
};
bool is_left_of(const Name& a, const Name& b) { return a.thing.x < b.thing.x; }

// Names above the walls, from left to right. Close names are pushed apart, with lines to their
// walls.
void draw_wall_names(const Pen& pen, const WallPicture& picture, const WallCamera& camera) {
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
         fmt::format("{}{:.4g} mm · {}", picture.two_axes ? axis : "",
                     wall.face_m * kMillimetresPerMetre, stiffness_text(wall.stiffness_n_per_m))});
  }
  std::sort(names.begin(), names.end(), is_left_of);
  float free_from = -1e6F;
  for (const Name& name : names) {
    // A wall whose top is outside is named at the edge of the picture.
    if (!pen.within(ImVec2(name.thing.x, std::max(name.thing.y, pen.area().corner.y)))) continue;
    const float half = 0.5F * ImGui::CalcTextSize(name.text.c_str()).x;
    const float x = picture.two_axes ? name.thing.x : std::max(name.thing.x, free_from + half);
    free_from = x + half + 0.7F * line;
    const ImVec2 text(x, std::max(name.thing.y - 1.2F * line, pen.area().corner.y + 0.7F * line));
    pen.line(name.thing, ImVec2(x, text.y + 0.5F * line), name.tone, 0.6F);
    pen.write(text, name.tone, name.text);
  }
}

// Names below their objects, pushed apart where they would overlap.
void draw_names_below(const Pen& pen, std::vector<Name> names, float level) {
  const float gap = ImGui::GetFontSize();
  std::sort(names.begin(), names.end(), is_left_of);
  float free_from = -1e6F;
  for (const Name& name : names) {
    if (!pen.within(name.thing)) continue;
    const float half = 0.5F * ImGui::CalcTextSize(name.text.c_str()).x;
    const ImVec2 text(std::max(name.thing.x, free_from + half),
                      std::max(level, name.thing.y + 0.5F * gap));
    free_from = text.x + half + gap;
    pen.line(name.thing, ImVec2(text.x, text.y - 0.1F * gap), name.tone, 0.8F);
    pen.write(ImVec2(text.x, text.y + 0.5F * gap), name.tone, name.text);
  }
}

// `side`: -1 left, 1 right of the object.
void draw_name_beside(const Pen& pen, const Name& name, float side) {
  if (!pen.within(name.thing)) return;
  const float gap = 1.2F * ImGui::GetFontSize();
  const float half = 0.5F * ImGui::CalcTextSize(name.text.c_str()).x;
  pen.line(name.thing, ImVec2(name.thing.x + side * gap, name.thing.y), name.tone, 0.8F);
  pen.write(ImVec2(name.thing.x + side * (gap + half + 3.0F), name.thing.y), name.tone, name.text);
}

std::string handle_name(const std::string& rhythm) {
  return rhythm.empty() ? "handle" : "handle · " + rhythm;
}

void draw_things_on_axis(const Pen& pen, const WallPicture& picture, const WallCamera& camera,
                         const std::string& rhythm) {
  constexpr float kRadius = WallMeasures::kHandleRadius;
  constexpr float kNeckHalf = 0.62F * kRadius;
  constexpr float kAtRod = -0.75F;  // of the handle's name, from the ball
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

void draw_things_on_plane(const Pen& pen, const WallPicture& picture, const WallCamera& camera,
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

void draw_force(const Pen& pen, const WallPicture& picture, const WallCamera& camera) {
  const SweptForce force = swept_force(picture);
  const glm::vec2 arrow = arrow_of(picture, force.most_n);
  if (glm::length(arrow) < kMinArrow) return;
  const glm::dvec2 place_m = swept_place(picture).to_m;
  const glm::vec3 from = picture.two_axes ? ball_centre(true, camera, place_m)
                                          : camera.point_of(place_m, WallMeasures::kArrowHeight);
  // Above the middle of the arrow. With two axes beyond its tip, because the arrow may point
  // towards the viewer.
  const glm::vec3 along(arrow.x, 0.0F, -arrow.y);
  const glm::vec3 beside = picture.two_axes ? from + (1.0F + 0.8F / glm::length(along)) * along
                                            : from + 0.5F * along + glm::vec3(0.0F, 0.3F, 0.0F);
  ImVec2 place = pen.screen(beside);
  if (!picture.two_axes) place.y -= 0.5F * ImGui::GetFontSize();
  pen.write(place, picture.saturated ? draw::Tone::kBad : draw::Tone::kForce,
            force_text(picture, force));
}

// The colour bar of stiffness, with the displayed stiffness.
class StiffnessBar {
 public:
  StiffnessBar(const Pen& pen, const WallPicture& picture)
      : pen_(pen), scale_(stiffness_scale(picture)), line_(ImGui::GetFontSize()) {
    const ViewArea& area = pen.area();
    length_ = std::min(0.45F * area.size.y, 7.0F * line_);
    right_ = area.corner.x + area.size.x - 0.8F * line_;
    left_ = right_ - 0.6F * line_;
    bottom_ = area.corner.y + area.size.y - 1.2F * line_;
    from_ = ImVec2(left_ - 5.6F * line_, bottom_ - length_ - 2.2F * line_);
  }
  [[nodiscard]] ImVec2 from() const { return from_; }
  [[nodiscard]] bool has_room() const { return length_ > 3.0F * line_; }

  void draw_colours() const {
    constexpr int kSteps = 16;
    const float part = length_ / kSteps;
    const ImU32 behind = pen_.theme().packed(draw::Tone::kPanel, 0.85F);
    pen_.list()->AddRectFilled(from_, ImVec2(right_ + 0.4F * line_, bottom_ + 0.8F * line_), behind,
                               4.0F);
    const char* title = "stiffness";
    pen_.list()->AddText(
        ImVec2(right_ - ImGui::CalcTextSize(title).x, bottom_ - length_ - 1.9F * line_),
        pen_.theme().packed(draw::Tone::kMuted), title);
    const auto shade = [&](int step) {
      const float share = static_cast<float>(step) / kSteps;
      return ImGui::ColorConvertFloat4ToU32(stiffness_colour(pen_.theme(), share));
    };
    for (int step = 0; step < kSteps; ++step) {
      const float lower = bottom_ - part * static_cast<float>(step);
      pen_.list()->AddRectFilledMultiColor(ImVec2(left_, lower - part), ImVec2(right_, lower),
                                           shade(step + 1), shade(step + 1), shade(step),
                                           shade(step));
    }
  }
  void mark(double n_per_m) const {
    const float y = level(n_per_m);
    pen_.list()->AddTriangleFilled(
        ImVec2(left_ - 0.1F * line_, y), ImVec2(left_ - 0.55F * line_, y - 0.3F * line_),
        ImVec2(left_ - 0.55F * line_, y + 0.3F * line_), pen_.theme().packed(draw::Tone::kText));
  }
  // Writes left of the bar, unless another text is there.
  void write(double n_per_m, draw::Tone tone, const std::string& text) {
    const float y = level(n_per_m);
    for (const float other : taken_)
      if (std::abs(other - y) < 1.1F * line_) return;
    const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
    pen_.list()->AddText(ImVec2(left_ - 0.8F * line_ - extent.x, y - 0.5F * extent.y),
                         pen_.theme().packed(tone), text.c_str());
    taken_.push_back(y);
  }

 private:
  [[nodiscard]] float level(double n_per_m) const {
    return bottom_ - length_ * scale_.share(n_per_m);
  }
  const Pen& pen_;
  StiffnessScale scale_;
  float line_;
  float length_ = 0.0F;
  float left_ = 0.0F;
  float right_ = 0.0F;
  float bottom_ = 0.0F;
  ImVec2 from_;
  std::vector<float> taken_;
};

void draw_stiffness_bar(StiffnessBar& bar, const WallPicture& picture) {
  bar.draw_colours();
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    const ShownStiffness& shown = picture.shown.at(axis);
    if (shown.strength <= 0.0) continue;
    const char* name = axis == 0 ? "x " : "y ";
    bar.mark(shown.n_per_m);
    bar.write(shown.n_per_m, draw::Tone::kText,
              (picture.two_axes ? name : "") + stiffness_text(shown.n_per_m));
  }
  const StiffnessScale scale = stiffness_scale(picture);
  for (const double end : {scale.softest_n_per_m(), scale.stiffest_n_per_m})
    bar.write(end, draw::Tone::kMuted, stiffness_text(end));
}

}  // namespace

std::string stiffness_text(double n_per_m) {
  if (n_per_m >= kNewtonsPerKilonewton)
    return fmt::format("{:.3g} kN/m", n_per_m / kNewtonsPerKilonewton);
  return fmt::format("{:.3g} N/m", n_per_m);
}

void draw_wall_labels(const draw::Theme& theme, const WallPicture& picture,
                      const WallCamera& camera, const ViewArea& area, const std::string& rhythm) {
  Pen pen(theme, camera, area);
  StiffnessBar bar(pen, picture);
  const bool with_bar = !picture.walls.empty() && bar.has_room();
  if (with_bar) pen.cover_from(bar.from());
  draw_ruler(pen, camera, Axis::kX, picture.two_axes);
  if (camera.space().y) draw_ruler(pen, camera, Axis::kY, picture.two_axes);
  draw_wall_names(pen, picture, camera);
  if (picture.two_axes) {
    draw_things_on_plane(pen, picture, camera, rhythm);
  } else {
    draw_things_on_axis(pen, picture, camera, rhythm);
  }
  draw_force(pen, picture, camera);
  if (with_bar) draw_stiffness_bar(bar, picture);
}

}  // namespace hapticwall::ui
