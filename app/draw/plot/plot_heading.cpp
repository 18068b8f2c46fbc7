#include "app/draw/plot/plot_heading.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/draw/axis/symbol_text.h"

namespace hapticwall::draw {
namespace {

constexpr float kDashEms = 1.2F;      // a legend entry's piece of line
constexpr float kDashWeight = 0.17F;  // share of the text size
constexpr float kDashShare = 0.6F;    // relative to the plot: the piece has more than one dash
constexpr float kExtraDashWeight = 0.36F;
constexpr float kHeadingNameEms = 1.5F;  // start of the entry's name
constexpr float kEntryGapEms = 0.6F;     // gap between two entries
constexpr float kEntryTailEms = 0.2F;    // gap behind the name of an entry

// An axis on the right has no heading, so its unit is in the legend.
std::string entry_text(const PlotDescription& plot, const PlotLine& line) {
  if (line.side == Side::kLeft) return line.name;
  return fmt::format("{} {} {}", line.name, plot.scale_of(line).unit,
                     line.side == Side::kRight ? "→" : "→→");
}

float entry_width(const std::string& text) {
  return symbol_text_size(text).x + (kHeadingNameEms + kEntryTailEms) * ImGui::GetFontSize();
}

struct LegendEntry {
  ImVec2 corner;
  const std::string& text;
  ImU32 colour;
  float weight;  // weight of the legend's line, in text sizes
  Dash dash;
  float alpha;  // opacity of the text
};

void draw_dash(const PlotSurface& surface, const LegendEntry& entry) {
  const float em = ImGui::GetFontSize();
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float middle = entry.corner.y + 0.6F * em;
  const std::array piece{ImVec2(entry.corner.x, middle),
                         ImVec2(entry.corner.x + kDashEms * em, middle)};
  draw_dashed(list, piece, entry.colour, entry.weight * em, entry.dash,
              kDashShare * ImGui::GetStyle().FontScaleMain);
  add_symbol_text(*list, ImVec2(entry.corner.x + kHeadingNameEms * em, entry.corner.y),
                  surface.theme->packed(Tone::kText, 0.85F * entry.alpha), entry.text);
}

// One entry of the legend; a click hides or shows the line.
void draw_legend_entry(PlotSurface& surface, const PlotDescription& plot, const PlotLine& line,
                       const std::string& text, ImVec2 corner) {
  ImGui::SetCursorScreenPos(corner);
  if (ImGui::InvisibleButton(fmt::format("##legend {}", line.name).c_str(),
                             ImVec2(entry_width(text), ems(1.2F))) &&
      surface.interactive) {
    *surface.hidden ^= line_bit(line.quantity);
  }
  if (surface.interactive && ImGui::IsItemHovered())
    ImGui::SetTooltip("%s\nclick to hide or show", line.meaning);
  const float alpha = is_drawn(surface, plot, line) ? 1.0F : 0.3F;
  draw_dash(surface,
            {corner, text, surface.theme->packed(line.tone, alpha), kDashWeight, line.dash, alpha});
}

// Legend entry for a trace of another run; it ignores clicks.
void draw_extra_entry(PlotSurface& surface, const PlotDescription& plot, const ExtraTrace& trace,
                      ImVec2 corner) {
  const auto line = std::find_if(plot.lines.begin(), plot.lines.end(), [&](const PlotLine& each) {
    return (trace.lines & line_bit(each.quantity)) != 0U &&
           (is_drawn(surface, plot, each) || hides_counts(surface, each));
  });
  const ImVec4 colour = extra_colour(*surface.theme, trace, line->tone);
  ImGui::SetCursorScreenPos(corner);
  ImGui::Dummy(ImVec2(entry_width(trace.label), 1.2F * ImGui::GetFontSize()));
  draw_dash(surface, {corner, trace.label, ImGui::ColorConvertFloat4ToU32(colour), kExtraDashWeight,
                      Dash::kSolid, 1.0F});
}

float extra_legend_width(const PlotSurface& surface, const PlotDescription& plot) {
  float width = 0.0F;
  for (const ExtraTrace& trace : surface.extra_traces) {
    if (is_drawn(surface, plot, trace))
      width += entry_width(trace.label) + kEntryGapEms * ImGui::GetFontSize();
  }
  return width;
}

// The rows of a legend, as they fill.
class LegendRows {
 public:
  LegendRows(ImVec2 corner, float start, float right)
      : left_(corner.x), right_(right), place_(start, corner.y + 1.0F) {}

  // The place of an entry of this width.
  ImVec2 next(float width) {
    if (place_.x + width > right_ + 1.0F && place_.x > left_) {
      place_ = ImVec2(left_, place_.y + row());
    }
    const ImVec2 place = place_;
    place_.x += width + kEntryGapEms * ImGui::GetFontSize();
    return place;
  }
  [[nodiscard]] float bottom() const { return place_.y + row(); }

 private:
  [[nodiscard]] static float row() { return 1.25F * ImGui::GetFontSize(); }
  float left_;
  float right_;
  ImVec2 place_;
};

// The entry of a line; `hand`: that of the hand, if it is not its name.
std::string text_of(const PlotDescription& plot, const PlotLine& line, const std::string& hand) {
  return line.tone == Tone::kHand && !hand.empty() ? hand : entry_text(plot, line);
}

void draw_entries(PlotSurface& surface, const PlotDescription& plot, const std::string& hand,
                  LegendRows& rows) {
  for (const PlotLine& line : plot.lines) {
    if (!is_chosen(surface, plot, line)) continue;
    const PlotLine shown = shown_line(surface, plot, line);
    const std::string text = text_of(plot, shown, hand);
    draw_legend_entry(surface, plot, shown, text, rows.next(entry_width(text)));
  }
  for (const ExtraTrace& trace : surface.extra_traces) {
    if (is_drawn(surface, plot, trace))
      draw_extra_entry(surface, plot, trace, rows.next(entry_width(trace.label)));
  }
}

// Begins at `left`; flush right if one row is enough, else in as many rows as needed. `hand`: the
// entry of the hand, if it is not its name. Returns the bottom.
float draw_legend(PlotSurface& surface, const PlotDescription& plot, const std::string& hand,
                  float left, ImVec2 corner, float width) {
  const float gap = ems(kEntryGapEms);
  float total = -gap;
  for (const PlotLine& line : plot.lines) {
    if (is_chosen(surface, plot, line))
      total += entry_width(text_of(plot, shown_line(surface, plot, line), hand)) + gap;
  }
  const float right = corner.x + width;
  total += extra_legend_width(surface, plot);
  LegendRows rows(corner, std::max(left, right - total), right);
  draw_entries(surface, plot, hand, rows);
  return rows.bottom();
}

// The counts are shown on demand, whatever the settings of an earlier version have chosen.
void choose_line(const PlotSurface& surface, const PlotLine& line, bool on, bool was_hidden,
                 LineSet& chosen) {
  const bool counts = surface.simulated && line.quantity == &Sample::position_m;
  if (counts && surface.show_counts != nullptr) *surface.show_counts = on;
  if (was_hidden) {
    chosen |= line_bit(line.quantity);
  } else if (!counts || surface.show_counts == nullptr) {
    chosen ^= line_bit(line.quantity);
  }
}

void draw_choice_of_lines(PlotSurface& surface, const PlotDescription& plot) {
  LineSet& chosen = (*surface.chosen)[static_cast<std::size_t>(plot.id)];
  for (const PlotLine& line : plot.lines) {
    bool on = is_chosen(surface, plot, line);
    const bool was_hidden = hides_counts(surface, line);
    ImGui::BeginDisabled(line.is_truth() && !surface.simulated);
    ImGui::PushStyleColor(ImGuiCol_CheckMark, surface.theme->colour(line.tone));
    const char* name = line.quantity == &Sample::position_m ? "encoder counts" : line.name;
    if (ImGui::Checkbox(fmt::format("{}###signal {}", name, line.name).c_str(), &on))
      choose_line(surface, line, on, was_hidden, chosen);
    ImGui::PopStyleColor();
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::TextDisabled("%s", plot.scale_of(line).unit);
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
      ImGui::SetTooltip("%s", line.meaning);
  }
  if (plot.id != PlotId::kStiffness || surface.show_bounds == nullptr) return;
  ImGui::Separator();
  ImGui::Checkbox("bounds of theory###bounds", surface.show_bounds);
  ImGui::SetItemTooltip(
      "The stiffest wall without an algorithm, by four criteria:\n"
      "lines across this plot, if they are within its axis");
}

// The button with three dots and its menu.
void draw_signals_button(PlotSurface& surface, const PlotDescription& plot) {
  ImGui::SameLine();
  begin_choice(*surface.theme, false);
  if (ImGui::SmallButton(fmt::format("…###signals {}", plot.title).c_str()))
    ImGui::OpenPopup("signals");
  end_choice();
  ImGui::SetItemTooltip("Which signals this plot shows");
  if (!ImGui::BeginPopup("signals")) return;
  draw_choice_of_lines(surface, plot);
  ImGui::EndPopup();
}

}  // namespace

bool hides_counts(const PlotSurface& surface, const PlotLine& line) {
  return surface.simulated && line.quantity == &Sample::position_m &&
         surface.show_counts != nullptr && !*surface.show_counts;
}

PlotLine shown_line(const PlotSurface& surface, const PlotDescription& plot, const PlotLine& line) {
  const auto measured = std::ranges::find_if(plot.lines, [&](const PlotLine& other) {
    return line.measured_as == other.quantity && hides_counts(surface, other);
  });
  if (measured == plot.lines.end()) return line;
  PlotLine shown = line;
  shown.name = measured->name;
  shown.tone = measured->tone;
  shown.dash = measured->dash;
  return shown;
}

bool is_chosen(const PlotSurface& surface, const PlotDescription& plot, const PlotLine& line) {
  if (hides_counts(surface, line)) return false;
  const LineSet chosen = (*surface.chosen)[static_cast<std::size_t>(plot.id)];
  return (chosen & line_bit(line.quantity)) != 0U && (surface.simulated || !line.is_truth());
}

bool is_drawn(const PlotSurface& surface, const PlotDescription& plot, const PlotLine& line) {
  return is_chosen(surface, plot, line) && (*surface.hidden & line_bit(line.quantity)) == 0U;
}

void draw_plot_heading(PlotSurface& surface, const PlotDescription& plot, const std::string& mark,
                       const std::string& hand, float width) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  if (surface.theme->prints()) {
    strong_text(*surface.theme, mark);
  } else {
    strong_text(*surface.theme, mark + plot.title);
    ImGui::SameLine();
    ImGui::TextDisabled("%s", plot.left.unit);
  }
  if (surface.interactive) draw_signals_button(surface, plot);
  const FontScope font(nullptr, kSmallFontSize);
  const float left = ImGui::GetItemRectMax().x + ImGui::GetFontSize();
  const float below = ImGui::GetCursorScreenPos().y;
  const float bottom = draw_legend(surface, plot, hand, left, corner, width);
  ImGui::SetCursorScreenPos(ImVec2(corner.x, std::max(below, bottom)));
}

void draw_plot_legends(PlotSurface& surface, std::span<const LegendOf> plots, float width) {
  const FontScope font(nullptr, kSmallFontSize);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  LegendRows rows(corner, corner.x, corner.x + width);
  for (const LegendOf& each : plots) {
    ImGui::PushID(each.plot.title);
    draw_entries(surface, each.plot, each.hand, rows);
    ImGui::PopID();
  }
  ImGui::SetCursorScreenPos(ImVec2(corner.x, rows.bottom()));
}

}  // namespace hapticwall::draw
