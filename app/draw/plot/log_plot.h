// A printed plot with two logarithmic axes: marks joined by lines, each with its label.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/ui/theme.h"

namespace hapticwall::ui {

enum class Mark : std::uint8_t { kCircle, kSquare, kDiamond };

struct LogPoint {
  double x = 1.0;  // above 0
  double y = 1.0;  // 0 or above; 0 is drawn at the foot and says so in its label
  std::string label;
  bool filled = true;
};

struct LogSeries {
  std::string name;
  Tone tone = Tone::kText;
  Mark mark = Mark::kCircle;
  float radius = 1.0F;           // of the marks, in the usual radius
  bool labels_above = true;      // where there is room
  std::vector<LogPoint> points;  // in the order in which they are joined
};

struct LogPlot {
  std::string title;
  std::string unit;
  std::string x_title;
  std::optional<double> goal;  // a line across at this y
  std::string nothing;         // said where no point has a y above 0
  std::vector<LogSeries> series;
};

// What an axis shows, in powers of ten: half of one at least.
struct Decades {
  double from = 0.0;
  double to = 1.0;
  double zero = 0.0;  // where a 0 is drawn
};

struct AxisNumber {
  double value = 1.0;
  std::string text;
};

// What is written beside an axis, two numbers at least: powers of ten, and where there are too few
// of them their twofold and fivefold, and so on.
[[nodiscard]] std::vector<AxisNumber> axis_numbers(const Decades& decades);

// Draws heading, plot and the title of the x axis into `size`.
void draw_log_plot(const Theme& theme, const LogPlot& plot, ImVec2 size, float scale);

// The mark of a series in a line of text; the next item stands beside it.
void draw_legend_mark(const Theme& theme, Tone tone, Mark mark, bool filled);

}  // namespace hapticwall::ui
