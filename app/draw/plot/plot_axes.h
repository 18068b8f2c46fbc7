// Common parts of all plots: flags, lines, and axes of values.
#pragma once

#include <implot.h>

#include "app/draw/plot/sample_pyramid.h"

namespace hapticwall::draw {

inline constexpr ImPlotAxisFlags kAxisFlags = ImPlotAxisFlags_NoMenus | ImPlotAxisFlags_NoHighlight;
[[nodiscard]] ImPlotFlags plot_flags(bool interactive);

// A line without an entry in ImPlot's legend; axes do not fit to it.
[[nodiscard]] ImPlotSpec line_spec(const ImVec4& colour);

// An axis of values: fitted to the visible range, or set by the user.
struct ValueAxis {
  bool manual = false;
  double minimum = 0.0;
  double maximum = 1.0;

  void fit(Extremes range);  // unless it is manual
  void set_up(ImAxis id, const char* format, ImPlotAxisFlags flags = 0);
  // Notices that the user has moved the axis of the current plot, or has double-clicked on it.
  void notice_input(ImAxis id);
};

// The range of the value axis: the extremes enlarged a little and rounded outwards to a round step.
[[nodiscard]] Extremes round_range(Extremes data, double smallest_span);

// Labels of a time axis, as ImPlot asks; `length_s`: a double with the visible length.
int format_time(double value, char* text, int size, void* length_s);

}  // namespace hapticwall::draw
