#include "app/draw/plot/plot_axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace hapticwall::draw {

ImPlotFlags plot_flags(bool interactive) {
  const ImPlotFlags flags = ImPlotFlags_CanvasOnly | ImPlotFlags_NoFrame;
  return interactive ? flags & ~ImPlotFlags_NoBoxSelect : flags | ImPlotFlags_NoInputs;
}

ImPlotSpec line_spec(const ImVec4& colour) {
  ImPlotSpec spec;
  spec.LineColor = colour;
  spec.Flags = ImPlotItemFlags_NoLegend | ImPlotItemFlags_NoFit;
  return spec;
}

void ValueAxis::fit(Extremes range) {
  if (manual) return;
  minimum = range.minimum;
  maximum = range.maximum;
}

void ValueAxis::set_up(ImAxis id, const char* format, ImPlotAxisFlags flags) {
  ImPlot::SetupAxis(id, nullptr, kAxisFlags | flags);
  ImPlot::SetupAxisLinks(id, &minimum, &maximum);
  ImPlot::SetupAxisFormat(id, format);
}

void ValueAxis::notice_input(ImAxis id) {
  constexpr double kMoved = 1e-9;  // share of the span: more than a rounding error
  const bool across = id == ImAxis_X1;
  const ImPlotRect limits = ImPlot::GetPlotLimits(ImAxis_X1, across ? ImAxis_Y1 : id);
  const ImPlotRange& now = across ? limits.X : limits.Y;
  const double moved = std::abs(now.Min - minimum) + std::abs(now.Max - maximum);
  if (moved > kMoved * (maximum - minimum)) manual = true;
  if (!ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) return;
  if (ImPlot::IsPlotHovered() || ImPlot::IsAxisHovered(id)) manual = false;
}

Extremes round_range(Extremes data, double smallest_span) {
  constexpr double kMargin = 0.05;  // share of the span, on either side
  constexpr double kSteps = 16.0;   // approximate number of steps over the span
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

int format_time(double value, char* text, int size, void* length_s) {
  const double length = *static_cast<const double*>(length_s);
  // The axis has about ten ticks; one more digit distinguishes their labels.
  constexpr int kMaxDigits = 9;
  const int digits =
      std::clamp(static_cast<int>(std::ceil(1.0 - std::log10(length))), 0, kMaxDigits);
  std::string label = fmt::format("{:.{}f}", value, digits);
  if (digits > 0) {
    label.erase(label.find_last_not_of('0') + 1);
    if (label.back() == '.') label.pop_back();
  }
  if (label == "-0") label = "0";
  const auto end = fmt::format_to_n(text, static_cast<std::size_t>(size) - 1, "{} s", label);
  *end.out = '\0';
  return static_cast<int>(end.out - text);
}

}  // namespace hapticwall::draw
