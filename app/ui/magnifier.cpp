#include "app/ui/magnifier.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace hapticwall::ui {
namespace {

constexpr std::array kSpansM{1e-3, 2e-3, 5e-3};
constexpr double kFreeShare = 0.35;  // of the strip, in front of the wall
constexpr double kRoomToSpare =
    0.6;                             // of a span's depth: shrink when it would be filled no further
constexpr double kLookBackS = 0.5;   // for the choice of the span
constexpr double kTrailS = 0.1;      // of the handle's motion, shown as a band: longer than a frame
constexpr float kTickShare = 0.10F;  // length of an encoder tick, of the strip's height
constexpr double kScaleBarM = 1e-4;
constexpr double kMillimetresPerMetre = 1e3;

// The strip: from metres along the axis to pixels.
struct Strip {
  ImVec2 from;
  ImVec2 to;
  double face_m = 0.0;
  double span_m = 1e-3;

  [[nodiscard]] double pixels_per_m() const { return static_cast<double>(to.x - from.x) / span_m; }
  [[nodiscard]] float x_of(double position_m) const {
    const double left_m = face_m - kFreeShare * span_m;
    const double x = static_cast<double>(from.x) + (position_m - left_m) * pixels_per_m();
    // Far outside is as good as just outside, and safe for floats.
    return static_cast<float>(
        std::clamp(x, static_cast<double>(from.x) - 1e4, static_cast<double>(to.x) + 1e4));
  }
  [[nodiscard]] float height() const { return to.y - from.y; }
};

void draw_wall(const PanelContext& context, const Strip& strip, ImDrawList* list) {
  const float face = strip.x_of(strip.face_m);
  list->AddRectFilled(ImVec2(face, strip.from.y), strip.to,
                      context.theme.packed(Tone::kWall, 0.22F));
  list->AddLine(ImVec2(face, strip.from.y), ImVec2(face, strip.to.y),
                context.theme.packed(Tone::kWall), 2.0F);
}

// Where the encoder can tell the handle to be.
void draw_counts(const PanelContext& context, const Strip& strip, double encoder_m,
                 ImDrawList* list) {
  constexpr double kClosestPixels = 3.0;
  if (encoder_m * strip.pixels_per_m() < kClosestPixels) return;
  const auto first =
      static_cast<long>(std::ceil((strip.face_m - kFreeShare * strip.span_m) / encoder_m));
  const auto last =
      static_cast<long>(std::floor((strip.face_m + (1.0 - kFreeShare) * strip.span_m) / encoder_m));
  const float length = kTickShare * strip.height();
  for (long count = first; count <= last; ++count) {
    const float x = strip.x_of(static_cast<double>(count) * encoder_m);
    list->AddLine(ImVec2(x, strip.from.y), ImVec2(x, strip.to.y),
                  context.theme.packed(Tone::kText, 0.07F));
    list->AddLine(ImVec2(x, strip.to.y - length), ImVec2(x, strip.to.y),
                  context.theme.packed(Tone::kMuted), 1.5F);
  }
}

// The tip of the handle at its true position; behind it, where it was a moment ago.
void draw_handle(const PanelContext& context, const SampleHistory& history, const Strip& strip,
                 ImDrawList* list) {
  const float middle = strip.from.y + 0.5F * strip.height();
  const float half = 0.20F * strip.height();
  const double now_s = history.newest_time_s();
  const IndexRange recent = history.range(now_s - kTrailS, now_s);
  if (recent.count() > 0) {
    const Extremes trail = history.extremes(Quantity::kTruePosition, recent);
    list->AddRectFilled(ImVec2(strip.x_of(trail.minimum), middle - half),
                        ImVec2(strip.x_of(trail.maximum), middle + half),
                        context.theme.packed(Tone::kText, 0.16F), 0.3F * half);
  }
  const float tip = strip.x_of(context.snapshot.sample.truth.position_m);
  list->AddRectFilled(ImVec2(strip.from.x - half, middle - half), ImVec2(tip, middle + half),
                      context.theme.packed(Tone::kText, 0.85F), 0.45F * half,
                      ImDrawFlags_RoundCornersRight);
}

void draw_measured(const PanelContext& context, const Strip& strip, ImDrawList* list) {
  const float x = strip.x_of(context.snapshot.sample.position_m);
  const float reach = 0.29F * strip.height();
  const float middle = strip.from.y + 0.5F * strip.height();
  const ImU32 colour = context.theme.packed(Tone::kPosition);
  list->AddLine(ImVec2(x, middle - reach), ImVec2(x, middle + reach), colour, 2.0F);
  const float size = 0.3F * ImGui::GetFontSize();
  list->AddTriangleFilled(ImVec2(x - size, middle - reach - size),
                          ImVec2(x + size, middle - reach - size), ImVec2(x, middle - reach),
                          colour);
}

// The hand is often millimetres deeper than the strip is long: then the edge says how far.
void draw_hand(const PanelContext& context, const Strip& strip, ImDrawList* list) {
  if (!context.session.scene().hand) return;
  const double hand_m = context.snapshot.sample.truth.hand_path_m;
  const ImU32 colour = context.theme.packed(Tone::kHand);
  const float x = strip.x_of(hand_m);
  const float line = ImGui::GetFontSize();
  if (x > strip.from.x && x < strip.to.x) {
    list->AddLine(ImVec2(x, strip.from.y), ImVec2(x, strip.to.y), colour, 1.5F);
    return;
  }
  const bool deeper = x >= strip.to.x;
  const double distance_m = deeper ? hand_m - strip.face_m : strip.face_m - hand_m;
  const double distance_mm = distance_m * kMillimetresPerMetre;
  const std::string text = deeper ? fmt::format("hand {:.1f} mm inside →", distance_mm)
                                  : fmt::format("← hand {:.1f} mm outside", distance_mm);
  const float width = ImGui::CalcTextSize(text.c_str()).x;
  const float left = deeper ? strip.to.x - width - 0.5F * line : strip.from.x + 0.5F * line;
  list->AddText(ImVec2(left, strip.from.y + 0.35F * line), colour, text.c_str());
}

void draw_true_penetration(const PanelContext& context, const Strip& strip, ImDrawList* list) {
  const double penetration_m = context.snapshot.sample.truth.position_m - strip.face_m;
  if (penetration_m <= 0.0) return;
  const float line = ImGui::GetFontSize();
  const std::string text =
      fmt::format("true depth {:.3f} mm", penetration_m * kMillimetresPerMetre);
  list->AddText(ImVec2(strip.from.x + 0.5F * line, strip.from.y + 0.35F * line),
                context.theme.packed(Tone::kText), text.c_str());
}

void draw_scale_bar(const PanelContext& context, const Strip& strip, ImDrawList* list) {
  const float line = ImGui::GetFontSize();
  const auto length = static_cast<float>(kScaleBarM * strip.pixels_per_m());
  const ImVec2 start(strip.from.x + 0.7F * line,
                     strip.to.y - kTickShare * strip.height() - 0.8F * line);
  const ImU32 colour = context.theme.packed(Tone::kText);
  const float tick = 0.25F * line;
  list->AddLine(start, ImVec2(start.x + length, start.y), colour, 2.0F);
  for (const float x : {start.x, start.x + length}) {
    list->AddLine(ImVec2(x, start.y - tick), ImVec2(x, start.y + tick), colour, 1.5F);
  }
  list->AddText(ImVec2(start.x + length + 0.5F * line, start.y - 0.55F * line), colour, "0.1 mm");
}

void draw_heading(const PanelContext& context, const Strip* strip, double view_pixels_per_m) {
  ImGui::PushFont(context.theme.fonts.strong, 0.0F);
  ImGui::TextUnformatted("Contact");
  ImGui::PopFont();
  if (strip == nullptr) return;
  ImGui::SameLine();
  const double magnification = strip->pixels_per_m() / std::max(view_pixels_per_m, 1.0);
  ImGui::TextColored(context.theme.colour(Tone::kAccent), "magnified ×%.0f", magnification);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("against the view on the left");
}

void draw_legend(const PanelContext& context) {
  const auto entry = [&](Tone tone, const std::string& text) {
    const float size = ImGui::GetFontSize();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddRectFilled(
        ImVec2(corner.x, corner.y + 0.3F * size),
        ImVec2(corner.x + 0.55F * size, corner.y + 0.85F * size), context.theme.packed(tone), 2.0F);
    ImGui::SetCursorScreenPos(ImVec2(corner.x + 0.9F * size, corner.y));
    ImGui::TextDisabled("%s", text.c_str());
    ImGui::SameLine(0.0F, size);
  };
  entry(Tone::kText, "handle");
  entry(Tone::kPosition, "measured");
  if (const auto& encoder_m = context.session.scene().device.encoder_m) {
    entry(Tone::kMuted, fmt::format("counts of {:.4g} mm", *encoder_m * kMillimetresPerMetre));
  }
  ImGui::NewLine();
}

}  // namespace

double magnifier_span(double deepest_m, double current_span_m) {
  for (const double span_m : kSpansM) {
    const double depth_m = (1.0 - kFreeShare) * span_m;
    const double limit_m = span_m < current_span_m ? kRoomToSpare * depth_m : depth_m;
    if (deepest_m <= limit_m) return span_m;
  }
  return kSpansM.back();
}

void draw_magnifier(const PanelContext& context, const SampleHistory& history,
                    double view_pixels_per_m) {
  const std::vector<WallSettings>& walls = context.session.scene().walls;
  if (walls.empty()) {
    draw_heading(context, nullptr, view_pixels_per_m);
    ImGui::TextDisabled("This scene has no wall.");
    return;
  }
  const auto outermost =
      std::min_element(walls.begin(), walls.end(),
                       [](const auto& a, const auto& b) { return a.position_m < b.position_m; });
  double& span_m = context.state.transient.magnifier_span_m;
  const double now_s = history.newest_time_s();
  const IndexRange recent = history.range(now_s - kLookBackS, now_s);
  if (recent.count() > 0) {
    const double deepest_m =
        history.extremes(Quantity::kTruePosition, recent).maximum - outermost->position_m;
    if (deepest_m > 0.0) span_m = magnifier_span(deepest_m, span_m);
  }
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 free = ImGui::GetContentRegionAvail();
  const Strip strip{
      ImVec2(corner.x, corner.y + line),
      ImVec2(corner.x + std::max(free.x, 1.0F), corner.y + std::max(free.y - line, line + 1.0F)),
      outermost->position_m, span_m};
  draw_heading(context, &strip, view_pixels_per_m);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(strip.from, strip.to, context.theme.packed(Tone::kBackground));
  list->PushClipRect(strip.from, strip.to, true);
  ImGui::PushFont(nullptr, kSmallFontSize);
  draw_wall(context, strip, list);
  if (const auto& encoder_m = context.session.scene().device.encoder_m)
    draw_counts(context, strip, *encoder_m, list);
  draw_handle(context, history, strip, list);
  draw_measured(context, strip, list);
  draw_hand(context, strip, list);
  draw_true_penetration(context, strip, list);
  draw_scale_bar(context, strip, list);
  list->PopClipRect();
  ImGui::SetCursorScreenPos(ImVec2(strip.from.x, strip.to.y + 3.0F));
  draw_legend(context);
  ImGui::PopFont();
  context.state.transient.items.insert_or_assign("magnifier", ItemRect{strip.from, strip.to});
}

}  // namespace hapticwall::ui
