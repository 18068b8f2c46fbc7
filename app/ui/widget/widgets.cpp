#include "app/ui/widget/widgets.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <utility>

#include "app/ui/state/text_edit.h"

namespace hapticwall::ui {
namespace {

constexpr float kUnitEms = 3.1F;         // width kept free for the unit
constexpr float kArrowAndGapEms = 2.2F;  // before and after the title of a folding heading
constexpr float kTooltipWidthEms = 26.0F;
constexpr float kGapShare = 0.3F;  // between a tooltip and its window or tab, of a row

using TooltipPlace = ImVec2(const TooltipSpace&, ImVec2);

void explain_at(std::string_view text, const ImRect& window, TooltipPlace* place) {
  if (text.empty() ||
      !ImGui::IsItemHovered(ImGuiHoveredFlags_ForTooltip | ImGuiHoveredFlags_AllowWhenDisabled)) {
    return;
  }
  const float wrap = kTooltipWidthEms * ImGui::GetFontSize();
  const ImVec2 padding = ImGui::GetStyle().WindowPadding;
  const ImVec2 inner = ImGui::CalcTextSize(text.data(), text.data() + text.size(), false, wrap);
  ImGui::SetNextWindowPos(
      place({ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), window.Min, window.Max,
             ImGui::GetIO().DisplaySize, ImGui::GetFrameHeightWithSpacing() + padding.y},
            ImVec2(inner.x + 2.0F * padding.x, inner.y + 2.0F * padding.y)));
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(padding.x + wrap);  // from the edge of the tooltip
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

// The place beside a narrow window, or nullopt.
std::optional<ImVec2> place_beside(const TooltipSpace& space, ImVec2 size) {
  if (space.window_to.x - space.window_from.x > 0.5F * space.screen.x) return std::nullopt;
  const float gap = kGapShare * space.row;
  const float y = std::clamp(space.item_from.y, 0.0F, std::max(0.0F, space.screen.y - size.y));
  const float right = space.window_to.x + gap;
  if (right + size.x <= space.screen.x) return ImVec2(right, y);
  const float left = space.window_from.x - gap - size.x;
  if (left >= 0.0F) return ImVec2(left, y);
  return std::nullopt;
}

}  // namespace

void heading_text(const PanelContext& context, const char* title) {
  const FontScope font(context.theme.fonts.strong, 0.0F);
  ImGui::TextColored(context.theme.colour(draw::Tone::kAccent), "%s", title);
}

void section(const PanelContext& context, const char* title, bool asked_for) {
  ImGui::Dummy(ImVec2(0.0F, 0.2F * ImGui::GetFontSize()));
  heading_text(context, title);
  if (!asked_for) return;
  ImGui::SameLine();
  ImGui::TextDisabled("asked for");
  explain("The loop has not confirmed these values yet: they are not in force.");
}

bool folding_section(const PanelContext& context, const char* title, std::string_view summary,
                     bool asked_for) {
  // A locked section can still be unfolded.
  const bool locked = (ImGui::GetCurrentContext()->CurrentItemFlags & ImGuiItemFlags_Disabled) != 0;
  if (locked) ImGui::EndDisabled();
  ImGui::PushFont(context.theme.fonts.strong, 0.0F);
  ImGui::PushStyleColor(ImGuiCol_Text, context.theme.colour(draw::Tone::kAccent));
  // Aligns the arrow with the other headings.
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(0.0F, 2.0F));
  const std::string heading = asked_for ? fmt::format("{0}  asked for###section {0}", title)
                                        : fmt::format("{0}###section {0}", title);
  const bool open = ImGui::TreeNodeEx(heading.c_str(), ImGuiTreeNodeFlags_NoTreePushOnOpen |
                                                           ImGuiTreeNodeFlags_FramePadding |
                                                           ImGuiTreeNodeFlags_SpanAvailWidth);
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
  ImGui::PopFont();
  if (locked) ImGui::BeginDisabled();
  if (open) return true;
  const float text_width = ImGui::CalcTextSize(heading.c_str(), nullptr, true).x +
                           kArrowAndGapEms * ImGui::GetFontSize();
  ImGui::SameLine(ImGui::GetStyle().WindowPadding.x + text_width);
  const FontScope font(nullptr, draw::kSmallFontSize);
  ImGui::TextColored(context.theme.colour(draw::Tone::kMuted), "%.*s",
                     static_cast<int>(summary.size()), summary.data());
  return false;
}

void beside(float width, float gap) {
  ImGui::SameLine(0.0F, gap);
  if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
}

void muted_text(const PanelContext& context, std::string_view text) {
  const FontScope font(nullptr, draw::kSmallFontSize);
  draw::wrapped_text(context.theme.colour(draw::Tone::kMuted), text);
}

void progress_bar(const PanelContext& context, double fraction, const std::string& text) {
  constexpr float kAlpha = 0.4F;
  ImGui::PushStyleColor(ImGuiCol_PlotHistogram,
                        draw::with_alpha(context.theme.colour(draw::Tone::kAccent), kAlpha));
  ImGui::ProgressBar(static_cast<float>(fraction), ImVec2(-1.0F, 0.0F), text.c_str());
  ImGui::PopStyleColor();
}

void explain(std::string_view text) {
  explain_at(text, ImGui::GetCurrentWindowRead()->Rect(), tooltip_place);
}

// A window behind another tab may never have had its place. A write access would hide the tab from
// IsItemHovered().
void explain_tab(std::string_view text) {
  const ImGuiWindow* window = ImGui::GetCurrentWindowRead();
  const ImGuiDockNode* node = window->DockNode;
  explain_at(text, node != nullptr ? node->Rect() : window->Rect(), tab_tooltip_place);
}

ImVec2 tooltip_place(const TooltipSpace& space, ImVec2 size) {
  if (const auto beside = place_beside(space, size)) return *beside;
  const float x = std::clamp(space.item_from.x, 0.0F, std::max(0.0F, space.screen.x - size.x));
  const float below = space.item_to.y + space.row;
  if (below + size.y <= space.screen.y) return {x, below};
  return {x, std::max(0.0F, space.item_from.y - space.row - size.y)};
}

ImVec2 tab_tooltip_place(const TooltipSpace& space, ImVec2 size) {
  if (const auto beside = place_beside(space, size)) return *beside;
  const float x = std::clamp(space.item_from.x, 0.0F, std::max(0.0F, space.screen.x - size.x));
  // The tab is at the top of the window; the item may be its button alone.
  const float above = space.window_from.y - kGapShare * space.row - size.y;
  return {x, above >= 0.0F ? above : std::max(0.0F, space.screen.y - size.y)};
}

bool button(const std::string& label, std::string_view tooltip, const ButtonLook& look) {
  ImGui::BeginDisabled(!look.enabled);
  const bool clicked = look.small ? ImGui::SmallButton(label.c_str())
                                  : ImGui::Button(label.c_str(), ImVec2(look.width, 0.0F));
  ImGui::EndDisabled();
  explain(tooltip);
  return clicked;
}

bool choice_button(const PanelContext& context, const std::string& label, bool chosen,
                   std::string_view tooltip, const ButtonLook& look) {
  draw::begin_choice(context.theme, chosen);
  const bool clicked = button(label, tooltip, look);
  draw::end_choice();
  return clicked;
}

bool list_choice(const std::string& label, bool chosen, std::string_view tooltip) {
  const bool clicked = ImGui::Selectable(label.c_str(), chosen);
  explain(tooltip);
  return clicked;
}

void field_label(const PanelContext& context, std::string_view label, std::string_view tooltip,
                 std::string_view unit) {
  const float left = ImGui::GetCursorPosX();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(context.theme.colour(draw::Tone::kText), "%.*s",
                     static_cast<int>(label.size()), label.data());
  explain(tooltip);
  context.edit.tooltip = tooltip;
  // A long label pushes its field to the right instead of running into it.
  const float start = std::max(left + kLabelShare * width,
                               left + ImGui::GetItemRectSize().x + ImGui::GetStyle().ItemSpacing.x);
  ImGui::SameLine(start);
  ImGui::SetNextItemWidth(left + width - start - unit_width(unit));
}

float unit_width(std::string_view unit) { return unit.empty() ? 0.0F : ems(kUnitEms); }

void digits_text(const PanelContext& context, const std::string& text, draw::Tone tone) {
  const FontScope font(context.theme.fonts.digits, draw::kSmallFontSize);
  ImGui::TextColored(context.theme.colour(tone), "%s", text.c_str());
}

void figure_row(const PanelContext& context, std::string_view name, const std::string& text,
                draw::Tone tone, std::string_view tooltip) {
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::BeginGroup();
  muted_text(context, name);
  // Aligned with the text of the fields above; inside a group the row begins at 0.
  ImGui::SameLine(kLabelShare * width + ImGui::GetStyle().FramePadding.x);
  digits_text(context, text, tone);
  ImGui::EndGroup();
  explain(tooltip);
}

void unit_label(std::string_view unit) {
  if (unit.empty()) return;
  ImGui::SameLine(0.0F, ImGui::GetStyle().ItemInnerSpacing.x);
  ImGui::TextDisabled("%.*s", static_cast<int>(unit.size()), unit.data());
}

std::optional<std::string> text_field(const PanelContext& context, const char* id,
                                      const std::string& hint, const std::string& shown) {
  TextEdit& edit = context.edit;
  const ImGuiID field = ImGui::GetID(id);
  std::array<char, std::tuple_size_v<decltype(edit.text)>> text{};
  if (edit.field == field) {
    text = edit.text;
  } else {
    std::copy_n(shown.begin(), std::min(shown.size(), text.size() - 1), text.begin());
  }
  ImGui::InputTextWithHint(id, hint.c_str(), text.data(), text.size(),
                           ImGuiInputTextFlags_AutoSelectAll);
  if (ImGui::IsItemActive()) {
    edit.field = field;
    edit.text = text;
  }
  explain(std::exchange(edit.tooltip, {}));
  if (!ImGui::IsItemDeactivated()) return std::nullopt;
  edit.field = 0;
  // Escape has restored the old text: no edit.
  if (!ImGui::IsItemDeactivatedAfterEdit() || shown == text.data()) return std::nullopt;
  return std::string(text.data());
}

std::optional<double> number_field(const PanelContext& context, const char* id, double shown) {
  const auto text = text_field(context, id, "", rounded_number(shown));
  if (!text) return std::nullopt;
  const auto number = parse_number(*text);
  if (!number) {
    refuse(context, id, no_number(*text));
  } else if (is_refused(context, id)) {
    context.edit.refusal.reset();
  }
  return number;
}

void refuse(const PanelContext& context, const std::string& key, std::string why) {
  context.edit.refusal = Refusal{key, std::move(why)};
}

bool is_refused(const PanelContext& context, std::string_view key) {
  const auto& refusal = context.edit.refusal;
  return refusal && refusal->key == key;
}

void draw_refusal(const PanelContext& context, const std::string& key) {
  const auto& refusal = context.edit.refusal;
  if (!is_refused(context, key)) return;
  const FontScope font(nullptr, draw::kSmallFontSize);
  const ImVec2 from = ImGui::GetCursorScreenPos();
  ImGui::PushClipRect(from,
                      ImVec2(from.x + ImGui::GetContentRegionAvail().x,
                             from.y + ImGui::GetTextLineHeightWithSpacing()),
                      true);
  ImGui::TextColored(context.theme.colour(draw::Tone::kBad), "%s", refusal->why.c_str());
  ImGui::PopClipRect();
  explain(refusal->why);
}

}  // namespace hapticwall::ui
