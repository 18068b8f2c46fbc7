#include "app/draw/plot/extra_traces.h"

#include <fmt/format.h>
#include <imgui.h>
#include <implot.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "app/draw/plot/plot.h"
#include "app/draw/plot/plot_heading.h"

namespace hapticwall::draw {
namespace {

constexpr float kTraceWidth = 2.4F;  // relative to a line of the session

IndexRange visible_range(const PlotSurface& surface, const ExtraTrace& trace) {
  return trace.history->range(surface.window->from_s - trace.shift_s,
                              surface.window->to_s - trace.shift_s);
}

// True if the trace has the line and a piece of it is in sight.
bool has(const PlotSurface& surface, const ExtraTrace& trace, const PlotLine& line) {
  if (trace.history == nullptr || trace.history->empty()) return false;
  const bool in_sight = trace.history->oldest_time_s() + trace.shift_s < surface.window->to_s &&
                        trace.history->newest_time_s() + trace.shift_s > surface.window->from_s;
  return in_sight && (trace.lines & line_bit(line.quantity)) != 0U;
}

}  // namespace

void replace_extra_traces(std::vector<ExtraTrace>& all, ExtraSource source,
                          std::vector<ExtraTrace> traces) {
  std::erase_if(all, [source](const ExtraTrace& trace) { return trace.source == source; });
  for (ExtraTrace& trace : traces) trace.source = source;
  std::move(traces.begin(), traces.end(), std::back_inserter(all));
}

namespace {

// Traces have measured positions, which stay where the session shows only its true one.
bool has_drawn(const PlotSurface& surface, const PlotDescription& plot, const ExtraTrace& trace,
               const PlotLine& line) {
  return has(surface, trace, line) &&
         (is_drawn(surface, plot, line) || hides_counts(surface, line));
}

}  // namespace

bool is_drawn(const PlotSurface& surface, const PlotDescription& plot, const ExtraTrace& trace) {
  return std::any_of(plot.lines.begin(), plot.lines.end(),
                     [&](const PlotLine& line) { return has_drawn(surface, plot, trace, line); });
}

std::optional<Extremes> extra_extremes(const PlotSurface& surface, const PlotLine& line) {
  std::optional<Extremes> all;
  for (const ExtraTrace& trace : surface.extra_traces) {
    if (!has(surface, trace, line)) continue;
    const SampleStats stats = trace.history->stats(line.quantity, visible_range(surface, trace));
    if (!stats.empty()) include(all, stats.extremes);
  }
  return all;
}

void draw_extra_traces(const PlotSurface& surface, const PlotDescription& plot) {
  int index = 0;  // makes names of equal labels unique
  for (const ExtraTrace& trace : surface.extra_traces) {
    ++index;
    for (const PlotLine& line : plot.lines) {
      if (!has_drawn(surface, plot, trace, line)) continue;
      const ValueScale& scale = plot.scale_of(line);
      const std::string name = fmt::format("{}##extra{}", line.name, index);
      TraceSource source{*trace.history, line.quantity, visible_range(surface, trace), scale.scale,
                         trace.shift_s};
      source.knee = scale.knee;
      TraceStyle style{name.c_str(), extra_colour(*surface.theme, trace, line.tone),
                       kTraceWidth * surface.line_weight, Dash::kSolid, scale.smallest_span};
      style.column = surface.column;
      draw_trace(source, style, value_axis(line.side), *surface.scratch);
    }
  }
  ImPlot::SetAxes(ImAxis_X1, ImAxis_Y1);
}

void draw_extra_readout(const PlotSurface& surface, const PlotDescription& plot,
                        const PlotLine& line, double time_s) {
  for (const ExtraTrace& trace : surface.extra_traces) {
    if (!has_drawn(surface, plot, trace, line)) continue;
    const double own_s = time_s - trace.shift_s;
    const SampleHistory& history = *trace.history;
    if (own_s < history.oldest_time_s() || own_s > history.newest_time_s()) continue;
    const ValueScale& scale = plot.scale_of(line);
    ImGui::TextColored(extra_colour(*surface.theme, trace, line.tone), "%-20s %10.4f %s",
                       ("  " + trace.label).c_str(),
                       history.value(line.quantity, *history.nearest(own_s)) * scale.scale,
                       scale.unit);
  }
}

// Mixed, not transparent: overlapping pieces of a line do not get darker.
ImVec4 extra_colour(const Theme& theme, const ExtraTrace& trace, Tone of_line) {
  return mixed(theme.colour(Tone::kBackground), theme.colour(trace.tone.value_or(of_line)),
               trace.strength);
}

}  // namespace hapticwall::draw
