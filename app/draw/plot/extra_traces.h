// Traces of other runs, drawn over the plots: the same hand under another algorithm, a comparison.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/draw/plot/plot_lines.h"
#include "app/draw/plot/sample_history.h"
#include "app/draw/plot/theme.h"

namespace hapticwall::draw {

struct PlotSurface;

// The owner of a trace; each replaces only its own.
enum class ExtraSource : std::uint8_t { kReplay, kComparison };

// Lines of one such run. A plot draws the lines whose quantity it also draws for the session.
inline constexpr LineSet kExtraLines = line_bit(&Sample::position_m) | line_bit(&Sample::force_n) |
                                       line_bit(Derived::kStiffness) |
                                       line_bit(&Sample::energy_cv_j);

struct ExtraTrace {
  ExtraSource source = ExtraSource::kComparison;
  std::string label;                             // for the legend: "under virtual-coupling"
  std::shared_ptr<const SampleHistory> history;  // null or empty: nothing is drawn
  std::optional<Tone> tone;                      // tone of all its lines; nullopt: each has its own
  float strength = 0.5F;                         // 0: colour of the background, 1: of a line
  double shift_s = 0.0;                          // plot time of the trace's time 0
  LineSet lines = kExtraLines;
};

// Replaces the traces of this source by `traces`, which may be empty.
void replace_extra_traces(std::vector<ExtraTrace>& all, ExtraSource source,
                          std::vector<ExtraTrace> traces);

// True if this plot draws a line of it.
[[nodiscard]] bool is_drawn(const PlotSurface& surface, const PlotDescription& plot,
                            const ExtraTrace& trace);

// Extremes of a line over all traces within the window, in SI units; nullopt if no trace has it.
[[nodiscard]] std::optional<Extremes> extra_extremes(const PlotSurface& surface,
                                                     const PlotLine& line);

// Draws them into the current plot, as wide, soft lines below those of the session.
void draw_extra_traces(const PlotSurface& surface, const PlotDescription& plot);

// The values of a line at a time, for the readout.
void draw_extra_readout(const PlotSurface& surface, const PlotDescription& plot,
                        const PlotLine& line, double time_s);

// The colour of its line and of its legend entry.
[[nodiscard]] ImVec4 extra_colour(const Theme& theme, const ExtraTrace& trace, Tone of_line);

}  // namespace hapticwall::draw
