// Two cursors on the time axis, and what the signals are there.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "app/ui/plot_lines.h"
#include "app/ui/plot_trigger.h"
#include "app/ui/sample_history.h"

namespace hapticwall::ui {

struct Cursors {
  bool shown = false;
  std::array<double, 2> time_s{};
};

// Puts both into the window, a third of it apart.
void place_cursors(Cursors& cursors, TimeWindow window);

// Keeps both where they stand on the screen while the window moves on by itself.
void carry_cursors(Cursors& cursors, TimeWindow from, TimeWindow to);

// A signal at both cursors, in the unit of its plot.
struct CursorRow {
  const PlotLine* line = nullptr;
  const char* unit = "";
  std::array<double, 2> value{};

  [[nodiscard]] double difference() const { return value[1] - value[0]; }
};

struct CursorTable {
  std::array<double, 2> time_s{};  // of the samples that are nearest to the cursors
  std::vector<CursorRow> rows;     // empty where there are no samples

  [[nodiscard]] double difference_s() const { return time_s[1] - time_s[0]; }
  [[nodiscard]] std::optional<double> rate_hz() const;  // 1/Δt; nothing where Δt is 0
};

// Of all lines of these plots that are chosen and not hidden.
[[nodiscard]] CursorTable read_cursors(const SampleHistory& history, const Cursors& cursors,
                                       std::span<const PlotId> plots, const ChosenLines& chosen,
                                       HiddenLines hidden);

void draw_cursor_table(const Theme& theme, const CursorTable& table);

}  // namespace hapticwall::ui
