#include "app/ui/widget/sliders.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/ui/state/text_edit.h"
#include "app/ui/widget/widgets.h"

namespace hapticwall::ui {
namespace {

constexpr float kSliderHeightEms = 0.6F;  // height of the sensitive area
constexpr float kSliderTrackEms = 0.16F;
constexpr float kGrabEms = 0.28F;  // half of it
constexpr double kDigits = 3.0;
constexpr double kHalfWidthDecades = 1.5;
constexpr double kZeroShare = 0.01;  // share of the slider at its left end

double rounded(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) + 1.0 - kDigits);
  // Converts through text, because 1234 * 0.01 is not 12.34.
  return parse_number(fmt::format("{:.12g}", std::round(value / unit) * unit)).value_or(value);
}

void draw_track(const PanelContext& context, ImVec2 from, ImVec2 to, float share, bool held) {
  const float middle = 0.5F * (from.y + to.y);
  const float half = 0.5F * ems(kSliderTrackEms);
  const float grab = ems(kGrabEms);
  const float x = from.x + grab + share * (to.x - from.x - 2.0F * grab);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(ImVec2(from.x, middle - half), ImVec2(to.x, middle + half),
                      context.theme.packed(draw::Tone::kFaint), half);
  list->AddRectFilled(ImVec2(from.x, middle - half), ImVec2(x, middle + half),
                      context.theme.packed(draw::Tone::kAccent, 0.5F), half);
  list->AddCircleFilled(ImVec2(x, middle), grab,
                        context.theme.packed(draw::Tone::kAccent, held ? 1.0F : 0.85F));
}

// The share at which the pointer holds the grab. Grabbing it off its centre does not move it.
double dragged_share(const char* id, float from, float width, double share) {
  const float grab = kGrabEms * ImGui::GetFontSize();
  const float way = width - 2.0F * grab;
  const float pointer = ImGui::GetIO().MousePos.x - from - grab;
  float& beside = *ImGui::GetStateStorage()->GetFloatRef(ImGui::GetID(id));
  if (ImGui::IsItemActivated()) {
    beside = pointer - static_cast<float>(share) * way;
    if (std::abs(beside) > grab) beside = 0.0F;
  }
  return static_cast<double>((pointer - beside) / way);
}

}  // namespace

double slider_share(double value, const LogRange& range) {
  if (!(value > range.minimum)) return 0.0;
  const double share = std::log(value / range.minimum) / std::log(range.maximum / range.minimum);
  return std::min(share, 1.0);
}

double slider_value(double share, const LogRange& range) {
  if (range.zero_at_left && share < kZeroShare) return 0.0;
  const double within = std::clamp(share, 0.0, 1.0);
  const double value = range.minimum * std::pow(range.maximum / range.minimum, within);
  return std::clamp(rounded(value), range.minimum, range.maximum);
}

LogRange range_around(double usual, bool zero_at_left) {
  const double decades = std::log10(usual);
  return {std::pow(10.0, std::floor(decades - kHalfWidthDecades)),
          std::pow(10.0, std::ceil(decades + kHalfWidthDecades)), zero_at_left};
}

void type_where_asked(const PanelContext& context, const char* id) {
  ImGuiID& asked = context.edit.asked;
  if (asked == 0 || asked != ImGui::GetID(id)) return;
  ImGui::SetKeyboardFocusHere();
  promise_keyboard(context.edit);
  asked = 0;
}

std::optional<double> thin_slider(const PanelContext& context, const char* id, double shown,
                                  const LogRange& range, float from, float to) {
  const ImVec2 corner(from, ImGui::GetCursorScreenPos().y - ImGui::GetStyle().ItemSpacing.y);
  const ImVec2 size(std::max(to - from, 1.0F), kSliderHeightEms * ImGui::GetFontSize());
  ImGui::SetCursorScreenPos(corner);
  ImGui::InvisibleButton(fmt::format("{}-slider", id).c_str(), size);
  const bool held = ImGui::IsItemActive();
  const bool hovered = ImGui::IsItemHovered();
  draw_track(context, corner, ImVec2(corner.x + size.x, corner.y + size.y),
             static_cast<float>(slider_share(shown, range)), held || hovered);
  if (hovered || held) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  explain(fmt::format("{} to {}, logarithmic{}. Drag it, or Ctrl+click to type any value.",
                      rounded_number(range.minimum), rounded_number(range.maximum),
                      range.zero_at_left ? ", 0 at the left end" : ""));
  if (ImGui::IsItemActivated() && ImGui::GetIO().KeyCtrl) {
    context.edit.asked = ImGui::GetID(id);
    promise_keyboard(context.edit);
    ImGui::ClearActiveID();
    return std::nullopt;
  }
  if (!held) return std::nullopt;
  const double value =
      slider_value(dragged_share(id, from, size.x, slider_share(shown, range)), range);
  // A click without motion keeps all digits of a typed value.
  const double as_told = shown > 0.0 ? rounded(shown) : shown;
  return value == shown || value == as_told ? std::nullopt : std::optional(value);
}

std::optional<double> number_row(const PanelContext& context, const NumberRow& row) {
  const std::string id = fmt::format("##{}", row.name);
  field_label(context, row.label, row.tooltip, row.unit);
  type_where_asked(context, id.c_str());
  std::optional<double> value;
  if (const auto text = text_field(context, id.c_str(), "", rounded_number(row.value))) {
    value = parse_number(*text);
    context.edit.refusal.reset();
    if (!value) refuse(context, row.name, no_number(*text));
  }
  const float from = ImGui::GetItemRectMin().x;
  const float to = ImGui::GetItemRectMax().x;
  unit_label(row.unit);
  if (row.range) {
    const auto slid = thin_slider(context, id.c_str(), row.value, *row.range, from, to);
    if (slid) value = slid;
  }
  draw_refusal(context, row.name);
  return value;
}

}  // namespace hapticwall::ui
