#include "app/draw/plot/spectrum_plot.h"

#include <fmt/format.h>
#include <implot.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace hapticwall::draw {
namespace {

constexpr double kShownDecades = 4.0;  // decades shown below the strongest line
constexpr float kSignalEms = 9.0F;

void draw_signal_choice(const PlotSurface& surface, const PlotTable& table,
                        SpectrumSettings& settings, const char* chosen) {
  ImGui::SetNextItemWidth(ems(kSignalEms));
  if (!ImGui::BeginCombo("##spectrum signal", chosen, ImGuiComboFlags_HeightLargest)) return;
  for (const PlotId id : kAllPlots) {
    for (const PlotLine& line : table[id].lines) {
      if (line.is_truth() && !surface.simulated) continue;
      const std::string label = fmt::format("{0}###spectrum of {0}", line.name);
      if (ImGui::Selectable(label.c_str(), line.quantity == settings.quantity))
        settings.quantity = line.quantity;
      ImGui::SetItemTooltip("%s", line.meaning);
    }
  }
  ImGui::EndCombo();
}

void draw_spectrum_heading(const PlotSurface& surface, const PlotTable& table,
                           SpectrumSettings& settings, const SpectrumView& view,
                           const PlottedLine& chosen) {
  strong_text(*surface.theme, "Spectrum");
  ImGui::SameLine();
  const FontScope font(nullptr, kSmallFontSize);
  if (surface.interactive) draw_signal_choice(surface, table, settings, chosen.line->name);
  ImGui::SameLine();
  if (!view.strongest) return ImGui::TextDisabled("no oscillation in this range");
  ImGui::Text("%.4g Hz  %.4g %s", view.strongest->frequency_hz,
              view.strongest->amplitude * chosen.scale().scale, chosen.scale().unit);
  ImGui::SetItemTooltip("The strongest line: its frequency and the amplitude of its sine");
}

IndexRange shown_range(const PlotSurface& surface) {
  double from_s = surface.window->from_s;
  double to_s = surface.window->to_s;
  if (surface.cursors != nullptr && surface.cursors->shown) {
    const auto& cursors = surface.cursors->time_s;
    from_s = std::min(cursors[0], cursors[1]);
    to_s = std::max(cursors[0], cursors[1]);
  }
  return surface.history->range_within(from_s, to_s);
}

// The largest amplitude of each column of pixels, not below the axis.
Trace points_of(const Spectrum& spectrum, double scale, double least, std::size_t columns) {
  Trace points;
  const std::size_t count = spectrum.amplitude.size();
  const std::size_t group = std::max<std::size_t>(count / std::max<std::size_t>(columns, 1), 1);
  for (std::size_t first = 0; first < count; first += group) {
    const auto begin = spectrum.amplitude.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = begin + static_cast<std::ptrdiff_t>(std::min(group, count - first));
    const auto largest = std::max_element(begin, end);
    points.time_s.push_back(static_cast<double>(largest - spectrum.amplitude.begin()) *
                            spectrum.step_hz);
    points.value.push_back(std::max(*largest * scale, least));
  }
  return points;
}

PlotArea draw_amplitudes(const PlotSurface& surface, const SpectrumView& view,
                         const PlottedLine& chosen, ImVec2 size) {
  if (!view.strongest) return {};
  if (!ImPlot::BeginPlot("##plot Spectrum", size, plot_flags(false))) return {};
  const double most = 2.0 * view.strongest->amplitude * chosen.scale().scale;
  const double least = most * std::pow(10.0, -kShownDecades);
  const Spectrum& spectrum = view.spectrum;
  ImPlot::SetupAxis(ImAxis_X1, nullptr, kAxisFlags);
  ImPlot::SetupAxisFormat(ImAxis_X1, "%g Hz");
  ImPlot::SetupAxis(ImAxis_Y1, nullptr, kAxisFlags);
  ImPlot::SetupAxisFormat(ImAxis_Y1, "%g");
  ImPlot::SetupAxisScale(ImAxis_Y1, ImPlotScale_Log10);
  ImPlot::SetupAxesLimits(0.0, spectrum.step_hz * static_cast<double>(spectrum.amplitude.size()),
                          least, most, ImPlotCond_Always);
  ImPlot::SetupFinish();
  const Trace points = points_of(spectrum, chosen.scale().scale, least,
                                 static_cast<std::size_t>(ImPlot::GetPlotSize().x));
  ImPlotSpec spec = line_spec(surface.theme->colour(chosen.line->tone));
  spec.LineWeight = surface.line_weight;
  ImPlot::PlotLine("##spectrum", points.time_s.data(), points.value.data(),
                   static_cast<int>(points.time_s.size()), spec);
  const PlotArea area{ImPlot::GetPlotPos(), ImPlot::GetPlotSize()};
  ImPlot::EndPlot();
  return area;
}

}  // namespace

PlotArea draw_spectrum_plot(const PlotSurface& surface, const PlotTable& table,
                            SpectrumSettings& settings, SpectrumView& view, ImVec2 size) {
  ImGui::PushID("spectrum");
  // The column of the quantity has gone.
  if (!table.find(settings.quantity)) settings = {settings.shown};
  const PlottedLine chosen = *table.find(settings.quantity);
  view.spectrum = spectrum_of(*surface.history, chosen.line->quantity, shown_range(surface));
  view.strongest = strongest_line(view.spectrum);
  ImGui::BeginGroup();  // starts all rows at the x of the first row
  const float top = ImGui::GetCursorPosY();
  draw_spectrum_heading(surface, table, settings, view, chosen);
  const float height = std::max(1.0F, size.y - (ImGui::GetCursorPosY() - top));
  ImGui::PushFont(surface.theme->fonts.digits, kSmallFontSize);
  const PlotArea area = draw_amplitudes(surface, view, chosen, ImVec2(size.x, height));
  ImGui::PopFont();
  ImGui::EndGroup();
  ImGui::PopID();
  return area;
}

}  // namespace hapticwall::draw
