#include "app/ui/plot.h"

#include <fmt/format.h>
#include <implot.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace hapticwall::ui {
namespace {

constexpr std::array kPositionLines{
    PlotLine{Quantity::kHandPath, "hand",
             "where the hand intends to be; the value axis does not stretch for it", Tone::kHand},
    PlotLine{Quantity::kPosition, "handle", "x, the position as the encoder tells it",
             Tone::kPosition}};
constexpr std::array kForceLines{
    PlotLine{Quantity::kWallForce, "wall F_e", "F_e, what the virtual wall asks for",
             Tone::kWallForce},
    PlotLine{Quantity::kForce, "actuator F_d",
             "F_d, what the algorithm makes of it: the force on the handle", Tone::kForce}};
constexpr std::array kStiffnessLines{PlotLine{Quantity::kStiffness, "force / penetration",
                                              "F_d over penetration; 0 out of contact",
                                              Tone::kStiffness}};
constexpr std::array kPassivityLines{
    PlotLine{Quantity::kEnergyBudget, "budget",
             "−T Σ b v²: the most that the hold may generate (Eq. 22)", Tone::kBudget},
    PlotLine{Quantity::kEnergyHold, "hold (9)", "Eq. 9: energy of the sample-and-hold",
             Tone::kHold},
    PlotLine{Quantity::kEnergyScv, "SCV (10)",
             "Eq. 10: what handle and actuator really exchanged, as the encoder sees it",
             Tone::kScv},
    PlotLine{Quantity::kEnergyCv, "observer (6)",
             "Eq. 6: the passivity observer of Hannaford and Ryu; blind to the hold",
             Tone::kObserver}};

const std::array<PlotDescription, 4> kPlots{
    PlotDescription{PlotId::kPosition, "Position", "mm", 1e3, 1.0, kPositionLines},
    PlotDescription{PlotId::kForce, "Force", "N", 1.0, 1.0, kForceLines},
    PlotDescription{PlotId::kStiffness, "Stiffness", "kN/m", 1e-3, 1.0, kStiffnessLines},
    PlotDescription{PlotId::kPassivity, "Passivity", "mJ", 1e3, 0.1, kPassivityLines}};

bool is_hidden(const PlotSurface& surface, const PlotLine& line) {
  return (*surface.hidden & line_bit(line.quantity)) != 0U;
}

// One entry of the legend, right to left from `right`; a click hides or shows the line.
float draw_legend_entry(const PlotSurface& surface, const PlotLine& line, float right, float top) {
  const float size = ImGui::GetFontSize();
  const float width = ImGui::CalcTextSize(line.name).x + 1.7F * size;
  const ImVec2 corner(right - width, top);
  ImGui::SetCursorScreenPos(corner);
  ImGui::PushID(line.name);
  if (ImGui::InvisibleButton("##legend", ImVec2(width, 1.2F * size))) {
    *surface.hidden ^= line_bit(line.quantity);
  }
  ImGui::PopID();
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s\nclick to hide or show", line.meaning);
  const float alpha = is_hidden(surface, line) ? 0.3F : 1.0F;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float middle = top + 0.6F * size;
  list->AddLine(ImVec2(corner.x, middle), ImVec2(corner.x + 1.2F * size, middle),
                surface.theme->packed(line.tone, alpha), 0.17F * size);
  list->AddText(ImVec2(corner.x + 1.5F * size, top),
                surface.theme->packed(Tone::kText, 0.85F * alpha), line.name);
  return corner.x - 0.6F * size;
}

Extremes value_range(const PlotSurface& surface, const PlotDescription& plot) {
  const SampleHistory& history = *surface.history;
  std::optional<Extremes> all;
  const auto include = [&](double low, double high) {
    if (!all) all = Extremes{low, high};
    all = Extremes{std::min(all->minimum, low), std::max(all->maximum, high)};
  };
  const IndexRange range = history.range(*surface.time_from_s, *surface.time_to_s);
  for (const PlotLine& line : plot.lines) {
    // The hand's intention lies far inside a stiff wall; the contact is what is to be seen.
    if (line.quantity == Quantity::kHandPath) continue;
    if (range.count() == 0 || is_hidden(surface, line)) continue;
    const Extremes extremes = history.extremes(line.quantity, range);
    include(extremes.minimum * plot.scale, extremes.maximum * plot.scale);
  }
  if (plot.id != PlotId::kPosition) {
    include(0.0, 0.0);
  } else if (!surface.walls.empty()) {
    const double face = surface.walls.front().position_m * plot.scale;
    include(face, face);
  }
  return round_range(all.value_or(Extremes{}), plot.smallest_span);
}

// Where the hand is beyond the value axis: how far, beside the title.
void note_hand_outside(const PlotSurface& surface, const PlotDescription& plot, Extremes values) {
  const IndexRange range = surface.history->range(*surface.time_from_s, *surface.time_to_s);
  if (plot.id != PlotId::kPosition || range.count() == 0) return;
  const double highest = surface.history->extremes(Quantity::kHandPath, range).maximum * plot.scale;
  if (highest <= values.maximum || (*surface.hidden & line_bit(Quantity::kHandPath)) != 0U) return;
  ImGui::SameLine(0.0F, ImGui::GetFontSize());
  ImGui::PushFont(nullptr, kSmallFontSize);
  ImGui::TextColored(surface.theme->colour(Tone::kHand), "hand up to %.4g %s ↑", highest,
                     plot.unit);
  ImGui::PopFont();
}

void draw_heading(const PlotSurface& surface, const PlotDescription& plot, const std::string& mark,
                  Extremes values, float width) {
  const Theme& theme = *surface.theme;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::PushFont(theme.fonts.strong, 0.0F);
  ImGui::TextUnformatted(fmt::format("{}{}", mark, plot.title).c_str());
  ImGui::PopFont();
  ImGui::SameLine();
  ImGui::TextDisabled("%s", plot.unit);
  note_hand_outside(surface, plot, values);
  const ImVec2 below(corner.x, ImGui::GetCursorScreenPos().y);
  ImGui::PushFont(nullptr, kSmallFontSize);
  float right = corner.x + width;
  for (auto line = plot.lines.rbegin(); line != plot.lines.rend(); ++line) {
    right = draw_legend_entry(surface, *line, right, corner.y + 1.0F);
  }
  ImGui::PopFont();
  ImGui::SetCursorScreenPos(below);
}

void set_up_axes(const PlotSurface& surface, Extremes values) {
  const ImPlotAxisFlags flags = ImPlotAxisFlags_NoMenus | ImPlotAxisFlags_NoHighlight;
  const ImPlotAxisFlags time_labels = surface.time_labels ? 0 : ImPlotAxisFlags_NoTickLabels;
  ImPlot::SetupAxis(ImAxis_X1, nullptr, flags | time_labels);
  ImPlot::SetupAxis(ImAxis_Y1, nullptr, flags);
  ImPlot::SetupAxisLinks(ImAxis_X1, surface.time_from_s, surface.time_to_s);
  ImPlot::SetupAxisFormat(ImAxis_X1, "%g s");
  ImPlot::SetupAxisFormat(ImAxis_Y1, "%6.4g");
  ImPlot::SetupAxisLimits(ImAxis_Y1, values.minimum, values.maximum,
                          surface.fit_values ? ImPlotCond_Always : ImPlotCond_Once);
  ImPlot::SetupFinish();
}

// The wall as the region that it fills: x grows into it.
void draw_walls(const PlotSurface& surface, const PlotDescription& plot) {
  const ImPlotRect limits = ImPlot::GetPlotLimits();
  ImDrawList* list = ImPlot::GetPlotDrawList();
  ImPlot::PushPlotClipRect();
  for (const WallSettings& wall : surface.walls) {
    const double face = wall.position_m * plot.scale;
    const ImVec2 face_left = ImPlot::PlotToPixels(limits.X.Min, face);
    const ImVec2 far_right = ImPlot::PlotToPixels(limits.X.Max, std::max(limits.Y.Max, face));
    list->AddRectFilled(ImVec2(face_left.x, far_right.y), ImVec2(far_right.x, face_left.y),
                        surface.theme->packed(Tone::kWall, 0.10F));
    list->AddLine(face_left, ImVec2(far_right.x, face_left.y), surface.theme->packed(Tone::kWall),
                  1.5F);
  }
  ImPlot::PopPlotClipRect();
}

void draw_zero_line(const PlotSurface& surface) {
  const double zero = 0.0;
  ImPlotSpec spec;
  spec.LineColor = surface.theme->colour(Tone::kMuted);
  spec.LineColor.w = 0.6F;
  spec.Flags = ImPlotInfLinesFlags_Horizontal | ImPlotItemFlags_NoLegend | ImPlotItemFlags_NoFit;
  ImPlot::PlotInfLines("##zero", &zero, 1, spec);
}

void draw_lines(const PlotSurface& surface, const PlotDescription& plot) {
  const IndexRange range = surface.history->range(*surface.time_from_s, *surface.time_to_s);
  if (range.count() == 0) return;
  const auto columns = static_cast<std::size_t>(std::max(2.0F, ImPlot::GetPlotSize().x));
  for (const PlotLine& line : plot.lines) {
    if (is_hidden(surface, line)) continue;
    Trace& trace = *surface.scratch;
    surface.history->decimate(line.quantity, range, columns, plot.scale, trace);
    ImPlotSpec spec;
    spec.LineColor = surface.theme->colour(line.tone);
    spec.LineWeight = surface.line_weight;
    spec.Flags = ImPlotItemFlags_NoLegend | ImPlotItemFlags_NoFit;
    ImPlot::PlotLine(line.name, trace.time_s.data(), trace.value.data(),
                     static_cast<int>(trace.time_s.size()), spec);
  }
}

// Values of all lines at the sample under the pointer.
void draw_readout(const PlotSurface& surface, const PlotDescription& plot) {
  if (!surface.interactive || surface.history->empty() || !ImPlot::IsPlotHovered()) return;
  const double pointed_s = ImPlot::GetPlotMousePos().x;
  const std::span<const double> time = surface.history->column(Quantity::kTime);
  if (pointed_s < time.front() || pointed_s > time.back()) return;
  const auto index = static_cast<std::size_t>(
      std::lower_bound(time.begin(), time.end(), pointed_s) - time.begin());
  ImGui::BeginTooltip();
  ImGui::PushFont(surface.theme->fonts.digits, kSmallFontSize);
  ImGui::Text("%-20s %10.4f s", "time", time[index]);
  for (const PlotLine& line : plot.lines) {
    const double value = surface.history->column(line.quantity)[index] * plot.scale;
    ImGui::TextColored(surface.theme->colour(line.tone), "%-20s %10.4f %s", line.name, value,
                       plot.unit);
  }
  ImGui::PopFont();
  ImGui::EndTooltip();
}

}  // namespace

const PlotDescription& plot_description(PlotId id) { return kPlots[static_cast<std::size_t>(id)]; }

Extremes round_range(Extremes data, double smallest_span) {
  constexpr double kMargin = 0.05;  // of the span, on either side
  constexpr double kSteps = 16.0;   // about as many steps as the span has
  const double middle = 0.5 * (data.minimum + data.maximum);
  const double span = std::max(data.maximum - data.minimum, smallest_span) * (1.0 + 2.0 * kMargin);
  const double power = std::pow(10.0, std::floor(std::log10(span / kSteps)));
  double step = 10.0 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * power * kSteps >= span) step = factor * power;
  }
  return {std::floor((middle - 0.5 * span) / step) * step,
          std::ceil((middle + 0.5 * span) / step) * step};
}

PlotArea draw_plot(const PlotSurface& surface, const PlotDescription& plot, const std::string& mark,
                   ImVec2 size) {
  ImGui::PushID(plot.title);
  const float top = ImGui::GetCursorPosY();
  const Extremes values = value_range(surface, plot);
  draw_heading(surface, plot, mark, values, size.x);
  const float height = size.y - (ImGui::GetCursorPosY() - top);
  ImGui::PushFont(surface.theme->fonts.digits, kSmallFontSize);
  ImPlotFlags flags = ImPlotFlags_CanvasOnly | ImPlotFlags_NoFrame;
  if (!surface.interactive) flags |= ImPlotFlags_NoInputs;
  PlotArea area;
  if (ImPlot::BeginPlot("##plot", ImVec2(size.x, height), flags)) {
    set_up_axes(surface, values);
    area = {ImPlot::GetPlotPos(), ImPlot::GetPlotSize()};
    if (plot.id == PlotId::kPosition) draw_walls(surface, plot);
    if (plot.id == PlotId::kPassivity) draw_zero_line(surface);
    draw_lines(surface, plot);
    draw_readout(surface, plot);
    ImPlot::EndPlot();
  }
  ImGui::PopFont();
  ImGui::PopID();
  return area;
}

}  // namespace hapticwall::ui
