#include "app/ui/plot_heading.h"

#include <fmt/format.h>

#include <algorithm>

namespace hapticwall::ui {
namespace {

constexpr float kDashEms = 1.2F;       // a legend entry's piece of line
constexpr float kTextAtEms = 1.5F;     // where its name begins
constexpr float kEntryGapEms = 0.6F;   // between two entries
constexpr float kEntryTailEms = 0.2F;  // behind its name

void remember(const PlotSurface& surface, const std::string& item) {
  if (surface.remember) surface.remember(item);
}

// The second axis tells its unit here, for it has no heading of its own.
std::string entry_text(const PlotDescription& plot, const PlotLine& line) {
  return line.on_right ? fmt::format("{} {} →", line.name, plot.right.unit) : line.name;
}

float entry_width(const std::string& text) {
  return ImGui::CalcTextSize(text.c_str()).x + (kTextAtEms + kEntryTailEms) * ImGui::GetFontSize();
}

// One entry of the legend; a click hides or shows the line.
void draw_legend_entry(PlotSurface& surface, const PlotDescription& plot, const PlotLine& line,
                       const std::string& text, ImVec2 corner) {
  const float em = ImGui::GetFontSize();
  ImGui::SetCursorScreenPos(corner);
  ImGui::PushID(line.name);
  if (ImGui::InvisibleButton("##legend", ImVec2(entry_width(text), 1.2F * em)) &&
      surface.interactive) {
    *surface.hidden ^= line_bit(line.quantity);
  }
  ImGui::PopID();
  remember(surface, fmt::format("legend {}", line.name));
  if (surface.interactive && ImGui::IsItemHovered())
    ImGui::SetTooltip("%s\nclick to hide or show", line.meaning);
  const float alpha = is_drawn(surface, plot, line) ? 1.0F : 0.3F;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float middle = corner.y + 0.6F * em;
  list->AddLine(ImVec2(corner.x, middle), ImVec2(corner.x + kDashEms * em, middle),
                surface.theme->packed(line.tone, alpha), 0.17F * em);
  list->AddText(ImVec2(corner.x + kTextAtEms * em, corner.y),
                surface.theme->packed(Tone::kText, 0.85F * alpha), text.c_str());
}

// From `left` on, flush right where one row is enough; else in as many rows as it takes. Returns
// the bottom.
float draw_legend(PlotSurface& surface, const PlotDescription& plot, float left, ImVec2 corner,
                  float width) {
  const float em = ImGui::GetFontSize();
  const float gap = kEntryGapEms * em;
  float total = -gap;
  for (const PlotLine& line : plot.lines) {
    if (is_chosen(surface, plot, line)) total += entry_width(entry_text(plot, line)) + gap;
  }
  const float right = corner.x + width;
  const float row = 1.25F * em;
  ImVec2 place(std::max(left, right - total), corner.y + 1.0F);
  for (const PlotLine& line : plot.lines) {
    if (!is_chosen(surface, plot, line)) continue;
    const std::string text = entry_text(plot, line);
    const float entry = entry_width(text);
    if (place.x + entry > right + 1.0F && place.x > corner.x) {
      place = ImVec2(corner.x, place.y + row);
    }
    draw_legend_entry(surface, plot, line, text, place);
    place.x += entry + gap;
  }
  return place.y + row;
}

void draw_choice_of_lines(PlotSurface& surface, const PlotDescription& plot) {
  LineSet& chosen = (*surface.chosen)[static_cast<std::size_t>(plot.id)];
  for (const PlotLine& line : plot.lines) {
    bool on = is_chosen(surface, plot, line);
    ImGui::BeginDisabled(line.kind == LineKind::kSimulator && !surface.simulated);
    ImGui::PushStyleColor(ImGuiCol_CheckMark, surface.theme->colour(line.tone));
    if (ImGui::Checkbox(line.name, &on)) chosen ^= line_bit(line.quantity);
    ImGui::PopStyleColor();
    ImGui::EndDisabled();
    remember(surface, fmt::format("signal {}", line.name));
    ImGui::SameLine();
    ImGui::TextDisabled("%s", plot.scale_of(line).unit);
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
      ImGui::SetTooltip("%s", line.meaning);
  }
  if (plot.id != PlotId::kStiffness || surface.show_bounds == nullptr) return;
  ImGui::Separator();
  ImGui::Checkbox("bounds of theory", surface.show_bounds);
  remember(surface, "bounds");
  ImGui::SetItemTooltip(
      "The stiffest wall without an algorithm, as four criteria have it:\n"
      "lines across this plot where its axis reaches them");
}

// Three dots behind the unit, and what they open.
void draw_signals_button(PlotSurface& surface, const PlotDescription& plot) {
  ImGui::SameLine();
  ImGui::PushStyleColor(ImGuiCol_Button, IM_COL32_BLACK_TRANS);
  if (ImGui::SmallButton("…")) ImGui::OpenPopup("signals");
  ImGui::PopStyleColor();
  remember(surface, fmt::format("signals {}", plot.title));
  ImGui::SetItemTooltip("Which signals this plot shows");
  if (!ImGui::BeginPopup("signals")) return;
  draw_choice_of_lines(surface, plot);
  ImGui::EndPopup();
}

}  // namespace

bool is_chosen(const PlotSurface& surface, const PlotDescription& plot, const PlotLine& line) {
  const LineSet chosen = (*surface.chosen)[static_cast<std::size_t>(plot.id)];
  return (chosen & line_bit(line.quantity)) != 0U;
}

bool is_drawn(const PlotSurface& surface, const PlotDescription& plot, const PlotLine& line) {
  return is_chosen(surface, plot, line) && (*surface.hidden & line_bit(line.quantity)) == 0U;
}

void draw_plot_heading(PlotSurface& surface, const PlotDescription& plot, const std::string& mark,
                       const std::string& note, float width) {
  const Theme& theme = *surface.theme;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::PushFont(theme.fonts.strong, 0.0F);
  ImGui::TextUnformatted(fmt::format("{}{}", mark, plot.title).c_str());
  ImGui::PopFont();
  ImGui::SameLine();
  ImGui::TextDisabled("%s", plot.left.unit);
  if (surface.interactive) draw_signals_button(surface, plot);
  ImGui::PushFont(nullptr, kSmallFontSize);
  if (!note.empty()) {
    ImGui::SameLine(0.0F, ImGui::GetFontSize());
    ImGui::TextColored(theme.colour(Tone::kHand), "%s", note.c_str());
  }
  const float left = ImGui::GetItemRectMax().x + ImGui::GetFontSize();
  const float below = ImGui::GetCursorScreenPos().y;
  const float bottom = draw_legend(surface, plot, left, corner, width);
  ImGui::PopFont();
  ImGui::SetCursorScreenPos(ImVec2(corner.x, std::max(below, bottom)));
}

}  // namespace hapticwall::ui
