// Printed plots with two logarithmic axes: marks joined by lines, each with its label. The plots
// are data without Dear ImGui; only the functions at the end draw.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/draw/plot/tone.h"

struct ImVec2;

namespace hapticwall::draw {

struct Theme;

enum class Mark : std::uint8_t { kCircle, kSquare, kDiamond };

struct LogPoint {
  double x = 1.0;  // above 0
  double y = 1.0;  // at least 0; 0 is drawn at the bottom with a label
  std::string label;
  bool filled = true;
};

struct LogSeries {
  std::string name;
  Tone tone = Tone::kText;
  Mark mark = Mark::kCircle;
  float radius = 1.0F;           // radius of the marks, as a multiple of the usual one
  bool labels_above = true;      // true: labels stand above the marks where there is room
  std::vector<LogPoint> points;  // joined in this order
};

struct LogPlot {
  std::string title;
  std::string quantity;        // of the y axis, with its symbol: "energy E"
  std::string unit;            // of the y axis
  std::string x_title;         // with its unit in brackets
  std::optional<double> goal;  // a line across at this y
  std::string nothing;         // text if no point has a y above 0
  std::vector<LogSeries> series;
};

// Plots side by side, with the same series, below a heading and a legend.
struct LogFigure {
  std::string title;
  std::string subject;  // text beside the title
  std::string note;     // text below the title
  std::string hollow;   // meaning of a hollow mark
  std::string labels;   // meaning of the labels
  std::string missing;  // names points that no plot shows; may be empty
  std::vector<LogPlot> plots;
};

// The range of an axis in powers of ten, at least half of one.
struct Decades {
  double from = 0.0;
  double to = 1.0;
  double zero = 0.0;  // exponent at which a 0 is drawn
};

struct AxisNumber {
  double value = 1.0;
  std::string text;
};

// The labels of an axis, at least two: powers of ten; if those are too few, also their multiples by
// two and five, and so on.
[[nodiscard]] std::vector<AxisNumber> axis_numbers(const Decades& decades);

// Draws heading, plot and the titles of its axes into `size`.
void draw_log_plot(const Theme& theme, const LogPlot& plot, ImVec2 size, float scale);

// Draws the keys of the series and the meaning of marks and labels, in as many lines as needed.
void draw_log_legend(const Theme& theme, const LogFigure& figure);

// The mark of a series within a line of text; the next item stands beside it.
void draw_legend_mark(const Theme& theme, Tone tone, Mark mark, bool filled);

// Draws legend and plots into `size`. `scale`: of lines and marks.
void draw_log_figure(const Theme& theme, const LogFigure& figure, ImVec2 size, float scale);

}  // namespace hapticwall::draw
