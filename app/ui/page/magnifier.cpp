#include "app/ui/page/magnifier.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/draw/wall/wall_strip.h"
#include "app/draw/wall/wall_trail.h"
#include "app/ui/panel/verdict_view.h"
#include "app/ui/wall/wall_state.h"
#include "app/ui/widget/overflow_row.h"
#include "app/ui/widget/shown_axis.h"
#include "app/ui/widget/widgets.h"

namespace hapticwall::ui {
namespace {

constexpr double kFreeShare = 0.35;   // share of the strip in front of the face
constexpr double kRoomToSpare = 0.8;  // magnify more only when the depth needs less than this share
constexpr double kLookBackS = 0.5;    // window for the choice of the magnification
constexpr double kFollowS = 0.1;      // window of the motion that must fit to be followed
constexpr double kNearerShare = 0.5;  // switch to another face when it is nearer by this factor
constexpr double kStayWithin = 0.40;  // share of the span, from its middle: range of the handle
constexpr double kWithinFace = 0.47;  // kStayWithin while the view is at the face

double depth_share(double unmagnified_m, int magnification) {
  return (1.0 - kFreeShare) * unmagnified_m / magnification;
}

// Range of the handle in the last `seconds`.
draw::Extremes recent_positions(const draw::SampleHistory& history, double seconds, double now_m) {
  const double newest_s = history.newest_time_s();
  const draw::IndexRange recent = history.range(newest_s - seconds, newest_s);
  if (recent.count() == 0) return {now_m, now_m};
  return history.extremes(&PlantTruth::position_m, recent);
}

// Updates and returns the magnification.
int choose_magnification(WallState& state, double deepest_m, double unmagnified_m) {
  int& magnification = state.transient.magnification;
  if (state.persisted.magnification > 0) {
    magnification = next_magnification(state.persisted.magnification, 0);
  } else if (deepest_m > 0.0 || magnification == 0) {
    magnification = suitable_magnification(deepest_m, unmagnified_m, magnification);
  }
  return magnification;
}

constexpr const char* kMagnifyLess = "–###magnify less";
constexpr const char* kMagnifyMore = "+###magnify more";
constexpr const char* kMagnifyAutomatically = "auto###magnify automatically";
constexpr const char* kWidestMagnification = "×1000";
constexpr const char* kContactTitle = "Contact";

float magnification_width() {
  return button_width(kMagnifyLess) + button_width(kMagnifyMore) +
         ImGui::CalcTextSize(kWidestMagnification).x + 2.0F * ImGui::GetStyle().ItemSpacing.x;
}

void draw_magnification(const PanelContext& context) {
  WallState& state = context.wall;
  const int now = state.transient.magnification;
  if (button(kMagnifyLess, "Magnify less; so does the wheel over the picture.", {.small = true}))
    state.persisted.magnification = next_magnification(now, -1);
  ImGui::SameLine();
  // Width of the longest text, so that the buttons do not move.
  const float width = ImGui::CalcTextSize(kWidestMagnification).x;
  ImGui::BeginGroup();
  ImGui::TextColored(context.theme.colour(draw::Tone::kAccent), "×%d", now);
  ImGui::SameLine(0.0F, 0.0F);
  ImGui::Dummy(ImVec2(std::max(width - ImGui::GetItemRectSize().x, 0.0F), 0.0F));
  ImGui::EndGroup();
  explain("Magnification relative to the initial wall view.");
  ImGui::SameLine();
  if (button(kMagnifyMore, "Magnify more; so does the wheel over the picture.", {.small = true}))
    state.persisted.magnification = next_magnification(now, 1);
}

void draw_automatic_magnification(WallState& state) {
  if (button(kMagnifyAutomatically,
             "Fits the depth of the last half second; so does a double click on the picture.",
             {.small = true}))
    state.persisted.magnification = 0;
}

void draw_heading(const PanelContext& context, bool with_choice) {
  const auto title = [&] { draw::strong_text(context.theme, kContactTitle); };
  if (!with_choice) return title();
  WallState& state = context.wall;
  // The bold title is a little wider than the usual text.
  const float title_width = ImGui::CalcTextSize(kContactTitle).x + ems(0.5F);
  std::vector<RowControl> controls{
      {title_width, 2, title}, {magnification_width(), 0, [&] { draw_magnification(context); }}};
  if (state.persisted.magnification != 0)
    controls.push_back(
        {button_width(kMagnifyAutomatically), 1, [&] { draw_automatic_magnification(state); }});
  draw_overflow_row(context, "contact", controls, {.small = true});
}

// Draws as many entries as fit.
void draw_legend(const PanelContext& context) {
  const float size = ImGui::GetFontSize();
  const auto entry = [&](draw::Tone tone, const std::string& text) {
    if (ImGui::GetContentRegionAvail().x < 0.9F * size + ImGui::CalcTextSize(text.c_str()).x)
      return;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddRectFilled(
        ImVec2(corner.x, corner.y + 0.3F * size),
        ImVec2(corner.x + 0.55F * size, corner.y + 0.85F * size), context.theme.packed(tone), 2.0F);
    ImGui::SetCursorScreenPos(ImVec2(corner.x + 0.9F * size, corner.y));
    ImGui::TextDisabled("%s", text.c_str());
    ImGui::SameLine(0.0F, size);
  };
  entry(draw::Tone::kText, "true");
  entry(draw::Tone::kPosition, "measured");
  entry(draw::Tone::kAccent, "proxy");
  const Scene scene = shown_scene(context);
  if (const auto& encoder_m = scene.x().device.encoder_m)
    entry(draw::Tone::kMuted, fmt::format("counts of {}", draw::length_text(*encoder_m)));
  ImGui::NewLine();
}

// The wheel over the strip, and a double click.
void take_pointer(const PanelContext& context, const draw::PixelBox& strip) {
  WallState& state = context.wall;
  ImGui::SetCursorScreenPos(strip.from);
  ImGui::InvisibleButton("##magnifier",
                         ImVec2(strip.to.x - strip.from.x, strip.to.y - strip.from.y));
  if (!ImGui::IsItemHovered()) return;
  ImGui::SetItemKeyOwner(ImGuiKey_MouseWheelY);
  const float wheel = ImGui::GetIO().MouseWheel;
  if (wheel != 0.0F) {
    state.persisted.magnification =
        next_magnification(state.transient.magnification, wheel > 0.0F ? 1 : -1);
  }
  if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) state.persisted.magnification = 0;
}

// The box of the strip in the current window, above the legend.
draw::PixelBox strip_box() {
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 free = ImGui::GetContentRegionAvail();
  return {corner,
          ImVec2(corner.x + std::max(free.x, 1.0F), corner.y + std::max(free.y - line, 1.0F))};
}

// The nearest face; keeps the previous one unless another is much nearer.
double face_to_look_at(const WallPicture& picture, double tip_m, double before_m) {
  const auto distance = [tip_m](double face_m) { return std::abs(tip_m - face_m); };
  const PictureWall* nearest = nullptr;
  bool before_is_there = false;
  for (const PictureWall& wall : picture.walls) {
    if (wall.axis != Axis::kX) continue;
    before_is_there = before_is_there || wall.face_m == before_m;
    if (nearest == nullptr || distance(wall.face_m) < distance(nearest->face_m)) nearest = &wall;
  }
  if (nearest == nullptr) return before_m;
  const bool stays =
      before_is_there && distance(nearest->face_m) > kNearerShare * distance(before_m);
  return stays ? before_m : nearest->face_m;
}

}  // namespace

int next_magnification(int current, int steps) {
  int index = 0;
  for (std::size_t i = 0; i < kMagnifications.size(); ++i)
    if (kMagnifications.at(i) <= current) index = static_cast<int>(i);
  const int last = static_cast<int>(kMagnifications.size()) - 1;
  return kMagnifications.at(static_cast<std::size_t>(std::clamp(index + steps, 0, last)));
}

int suitable_magnification(double deepest_m, double unmagnified_m, int current) {
  for (auto magnification = kMagnifications.rbegin(); magnification != kMagnifications.rend();
       ++magnification) {
    const bool grows = current > 0 && *magnification > current;
    const double limit_m =
        (grows ? kRoomToSpare : 1.0) * depth_share(unmagnified_m, *magnification);
    if (deepest_m <= limit_m) return *magnification;
  }
  return kMagnifications.front();
}

Magnified look_at_contact(const WallPicture& picture, double least_m, double most_m, double span_m,
                          const Magnified& before) {
  Magnified result;
  const double tip_m = picture.handle_m.x;
  result.face_m = face_to_look_at(picture, tip_m, before.face_m);
  const double at_face_m = result.face_m + (0.5 - kFreeShare) * span_m;
  result.middle_m = at_face_m;
  const bool beyond = most_m > at_face_m + kWithinFace * span_m;
  const bool can_be_followed = most_m - least_m < 2.0 * kStayWithin * span_m;
  if (!beyond || !can_be_followed) return result;
  const bool still_within = std::abs(most_m - before.middle_m) < kStayWithin * span_m &&
                            std::abs(least_m - before.middle_m) < kStayWithin * span_m;
  result.middle_m = still_within ? before.middle_m : 0.5 * (least_m + most_m);
  return result;
}

double recent_depth_m(const ContactView& view, const Magnified& magnified) {
  return recent_positions(view.history, kLookBackS, view.picture.handle_m.x).maximum -
         magnified.face_m;
}

double contact_span_m(WallState& state, double deepest_m, double unmagnified_m) {
  return unmagnified_m / choose_magnification(state, deepest_m, unmagnified_m);
}

void draw_contact(const draw::Theme& theme, const draw::PixelBox& box, double span_m,
                  const ContactView& view, Magnified& magnified, draw::Trace& trail) {
  const draw::Extremes recent = recent_positions(view.history, kFollowS, view.picture.handle_m.x);
  magnified = look_at_contact(view.picture, recent.minimum, recent.maximum, span_m, magnified);
  const draw::Strip strip{box.from, box.to, magnified.middle_m, span_m};
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(strip.from, strip.to, theme.packed(draw::Tone::kBackground));
  list->PushClipRect(strip.from, strip.to, true);
  const draw::FontScope font(nullptr, draw::kSmallFontSize);
  draw_strip(
      theme, strip,
      {&view.picture, magnified.face_m, view.newest.position_m, view.encoder_m, view.measured},
      list);
  draw_trail(theme, strip, {view.history, view.history.newest_time_s(), view.measured}, trail,
             list);
  list->PopClipRect();
}

void draw_magnifier(const PanelContext& context, const draw::SampleHistory& history,
                    double view_pixels_per_m) {
  const Scene scene = shown_scene(context);
  WallPicture picture = wall_picture(scene, shown_sample(context));
  if (outermost_wall(picture, Axis::kX) == nullptr) {
    draw_heading(context, false);
    ImGui::TextDisabled("This scene has no wall.");
    return;
  }
  WallState::Transient& state = context.wall.transient;
  const std::size_t axis = shown_index(context);
  picture.shown.front() = state.shown.at(axis);
  sweep(picture, Axis::kX, state.swept.at(axis));
  picture.verdict = draw::edge_tone(context.tails.at(axis));
  draw_heading(context, true);
  const draw::PixelBox box = strip_box();
  const double unmagnified_m =
      static_cast<double>(box.to.x - box.from.x) / std::max(view_pixels_per_m, 1.0);
  const ContactView view{picture, history, shown_sample(context), scene.x().device.encoder_m};
  const double span_m =
      contact_span_m(context.wall, recent_depth_m(view, state.magnified), unmagnified_m);
  take_pointer(context, box);
  draw_contact(context.theme, box, span_m, view, state.magnified, state.trail);
  ImGui::SetCursorScreenPos(ImVec2(box.from.x, box.to.y + 3.0F));
  const draw::FontScope font(nullptr, draw::kSmallFontSize);
  draw_legend(context);
}

}  // namespace hapticwall::ui
