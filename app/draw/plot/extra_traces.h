// Traces of other runs, drawn over the plots: the same hand under another algorithm, a comparison.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/ui/plot_lines.h"
#include "app/ui/sample_history.h"
#include "app/ui/theme.h"

namespace hapticwall::ui {

struct PlotSurface;

// Whose a trace is: each takes away only its own.
enum class ExtraSource : std::uint8_t { kReplay, kComparison };

// What is drawn of such a run where the plot draws the same quantity of the session.
inline constexpr LineSet kExtraLines = line_bit(Quantity::kPosition) | line_bit(Quantity::kForce) |
                                       line_bit(Quantity::kStiffness) |
                                       line_bit(Quantity::kEnergyCv);

struct ExtraTrace {
  ExtraSource source = ExtraSource::kComparison;
  std::string label;                             // for the legend: "under virtual-coupling"
  std::shared_ptr<const SampleHistory> history;  // null or empty: nothing is drawn
  std::optional<Tone> tone;                      // of all its lines; none: each has its own
  float strength = 0.5F;                         // of the colour: 0 is the background, 1 a line's
  double shift_s = 0.0;                          // its time 0 stands there
  LineSet lines = kExtraLines;
};

// Those of this source give way to `traces`, which may be none.
void replace_extra_traces(std::vector<ExtraTrace>& all, ExtraSource source,
                          std::vector<ExtraTrace> traces);

// Is there anything of it in this plot?
[[nodiscard]] bool is_drawn(const PlotSurface& surface, const PlotDescription& plot,
                            const ExtraTrace& trace);

// Their extremes of a line within the window, in SI units; nothing where none has it.
[[nodiscard]] std::optional<Extremes> extra_extremes(const PlotSurface& surface,
                                                     const PlotLine& line);

// Draws them into the current plot: as wide, soft lines, to be overdrawn by the session's own.
void draw_extra_traces(const PlotSurface& surface, const PlotDescription& plot);

// The values of a line at a time, for the readout.
void draw_extra_readout(const PlotSurface& surface, const PlotDescription& plot,
                        const PlotLine& line, double time_s);

// The colour of a line of it, or of its entry in the legend.
[[nodiscard]] ImVec4 extra_colour(const Theme& theme, const ExtraTrace& trace, Tone of_line);

}  // namespace hapticwall::ui
