#include "app/draw/figure/identify_figure.h"

#include <fmt/format.h>
#include <implot.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "app/draw/figure/page.h"
#include "core/units.h"

namespace hapticwall::draw {
namespace {

constexpr float kIdentifyDesignWidth = 1200.0F;  // px, at figure scale 1
constexpr float kIdentifyDesignHeight = 900.0F;
constexpr double kShownS = 4.0;

double at_s(const identify::Record& record, std::size_t tick) {
  return static_cast<double>(tick) * record.period_s;
}

FigureCurve curve_of(const identify::Record& record, const std::vector<double>& values,
                     std::size_t first, double scale, std::string name, Tone tone) {
  FigureCurve curve{std::move(name), tone, {}, {}};
  for (std::size_t i = first; i < values.size(); ++i) {
    curve.x.push_back(at_s(record, i));
    curve.y.push_back(values[i] * scale);
  }
  return curve;
}

// The range of all curves, with room.
std::pair<double, double> range_of(const FigurePanel& panel,
                                   std::vector<double> FigureCurve::*values, double room) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const FigureCurve& curve : panel.curves) {
    for (const double value : curve.*values) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  const double margin = room * (high - low);
  return {low - margin, high + margin};
}

void draw_panel(const Theme& theme, const FigurePanel& panel, ImVec2 size) {
  const std::string id = "##" + panel.title;
  if (!ImPlot::BeginPlot(id.c_str(), size, ImPlotFlags_NoInputs | ImPlotFlags_NoTitle)) return;
  constexpr double kPanelRoom = 0.1;
  ImPlot::SetupAxes("time, s", panel.title.c_str());
  const auto [begin, end] = range_of(panel, &FigureCurve::x, 0.0);
  const auto [low, high] = range_of(panel, &FigureCurve::y, kPanelRoom);
  ImPlot::SetupAxesLimits(begin, end, low, high, ImPlotCond_Always);
  for (const FigureCurve& curve : panel.curves) {
    ImPlotSpec spec;
    spec.LineColor = theme.colour(curve.tone);
    ImPlot::PlotLine(curve.name.c_str(), curve.x.data(), curve.y.data(),
                     static_cast<int>(curve.x.size()), spec);
  }
  ImPlot::EndPlot();
}

std::string numbers(const identify::Identification& found) {
  if (!found.fits) {
    return fmt::format("this model does not fit: residuals {:.2f} times the encoder's",
                       found.residual_ratio);
  }
  return fmt::format(
      "m = {:.4g} kg, b = {:.4g} N·s/m, f_c = {:.4g} N, delay and lag {:.4g} ms; residuals {:.3f} "
      "times the encoder's; m, b, f_c if the force scale is right",
      found.mass_kg.value, found.damping_n_s_per_m.value, found.friction_n.value,
      found.delay_s.value * kMillisecondsPerSecond, found.residual_ratio);
}

}  // namespace

std::vector<FigurePanel> identification_panels(const identify::Record& record,
                                               const identify::Identification& found) {
  const auto shown = static_cast<std::size_t>(kShownS / record.period_s);
  const std::size_t count = record.position_m.size();
  const std::size_t first = count - std::min(shown, count);
  FigureCurve model{"model", Tone::kForce, {}, {}};
  FigureCurve residual{"position - model", Tone::kText, {}, {}};
  const std::vector<identify::SegmentNormal> normals = identify::linearise(record, found.fit);
  for (std::size_t s = 0; s < normals.size(); ++s) {
    for (Eigen::Index i = 0; i < normals[s].residual_m.size(); ++i) {
      const std::size_t tick = found.fit.segments[s].first + static_cast<std::size_t>(i);
      const double residual_m = normals[s].residual_m[i];
      residual.x.push_back(at_s(record, tick));
      residual.y.push_back(residual_m / record.encoder_m);
      if (tick < first) continue;
      model.x.push_back(at_s(record, tick));
      model.y.push_back((record.position_m[tick] - residual_m) * kMillimetresPerMetre);
    }
  }
  return {{"position, mm",
           {curve_of(record, record.position_m, first, kMillimetresPerMetre, "measured",
                     Tone::kPosition),
            std::move(model)}},
          {"force, N", {curve_of(record, record.force_n, first, 1.0, "commanded", Tone::kForce)}},
          {"residual, encoder counts", {std::move(residual)}}};
}

FigureCurve thinned(FigureCurve curve, std::size_t columns) {
  const std::size_t count = curve.y.size();
  const std::size_t part = count / columns + 1;
  if (part <= 2) return curve;
  FigureCurve thin{std::move(curve.name), curve.tone, {}, {}};
  for (std::size_t first = 0; first < count; first += part) {
    const auto begin = curve.y.begin() + static_cast<std::ptrdiff_t>(first);
    const auto ends = std::minmax_element(
        begin, begin + static_cast<std::ptrdiff_t>(std::min(part, count - first)));
    for (const auto place :
         {std::min(ends.first, ends.second), std::max(ends.first, ends.second)}) {
      thin.x.push_back(curve.x[static_cast<std::size_t>(place - curve.y.begin())]);
      thin.y.push_back(*place);
    }
  }
  return thin;
}

void draw_panels(const Theme& theme, std::span<const FigurePanel> panels, ImVec2 size) {
  const auto count = static_cast<float>(panels.size());
  const float gaps = (count - 1.0F) * ImGui::GetStyle().ItemSpacing.y;
  for (const FigurePanel& panel : panels) {
    draw_panel(theme, panel, ImVec2(size.x, (size.y - gaps) / count));
  }
}

Result<file::Picture> draw_identification(const identify::Record& record,
                                          const identify::Identification& found, FigureSize size) {
  const float scale = std::min(static_cast<float>(size.width) / kIdentifyDesignWidth,
                               static_cast<float>(size.height) / kIdentifyDesignHeight);
  const std::vector<FigurePanel> panels = identification_panels(record, found);
  return draw_page(size, scale, [&](const Theme& theme) {
    strong_text(theme, "identification", kTitleFontSize);
    ImGui::SameLine();
    ImGui::TextDisabled("  %s", numbers(found).c_str());
    ImGui::Spacing();
    draw_panels(theme, panels, ImGui::GetContentRegionAvail());
  });
}

}  // namespace hapticwall::draw
