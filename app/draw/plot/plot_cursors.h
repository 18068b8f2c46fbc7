// Two cursors on the time axis and the values of the signals there.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "app/draw/plot/plot_lines.h"
#include "app/draw/plot/plot_trigger.h"
#include "app/draw/plot/sample_history.h"

namespace hapticwall::draw {

struct Cursors {
  bool shown = false;
  std::array<double, 2> time_s{};
};

// Places both in the window, at a third and at two thirds.
void place_cursors(Cursors& cursors, TimeWindow window);

// Keeps both at their place on the screen while the window follows the session.
void carry_cursors(Cursors& cursors, TimeWindow from, TimeWindow to);

// A signal at both cursors, in the unit of its plot.
struct CursorRow {
  const PlotLine* line = nullptr;
  const char* unit = "";
  std::array<double, 2> value{};
  // Statistics of the samples from one cursor to the other, both included; NaN without one.
  double mean = 0.0;
  double deviation = 0.0;  // standard deviation
  double peak_to_peak = 0.0;
  double rms = 0.0;

  [[nodiscard]] double difference() const { return value[1] - value[0]; }
};

struct CursorTable {
  std::array<double, 2> time_s{};  // times of the samples nearest to the cursors
  std::vector<CursorRow> rows;     // empty without samples
  double energy_j = 0.0;           // ∫ F_d dx by the encoder: from the handle to the actuator

  [[nodiscard]] double difference_s() const { return time_s[1] - time_s[0]; }
  [[nodiscard]] std::optional<double> rate_hz() const;  // 1/Δt; nullopt if Δt is 0
};

// The rows of all lines of these plots of `table` that are chosen and not hidden. They refer to the
// table. `simulated`: truths are known.
[[nodiscard]] CursorTable read_cursors(const SampleHistory& history, const Cursors& cursors,
                                       std::span<const PlotId> plots, const ChosenLines& chosen,
                                       HiddenLines hidden, bool simulated = true,
                                       const PlotTable& table = usual_plots());

void draw_cursor_table(const Theme& theme, const CursorTable& table);

}  // namespace hapticwall::draw
