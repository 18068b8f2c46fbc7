// The result of an identification as a picture.
#pragma once

#include <imgui.h>

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "app/draw/figure/paper.h"
#include "app/draw/plot/theme.h"
#include "app/file/picture.h"
#include "core/result.h"
#include "core/study/identify/identify.h"

namespace hapticwall::draw {

struct FigureCurve {
  std::string name;
  Tone tone;
  std::vector<double> x;
  std::vector<double> y;
};
// A part of the time axis: smallest value, 5 % and 95 % quantile, largest value.
struct SpreadPart {
  double x = 0.0;
  std::array<double, 4> values{};
};
// A bin of a histogram, and its share of all values.
struct Bin {
  double low = 0.0;
  double high = 0.0;
  double share = 0.0;
};
// Many values over time as bands, and their distribution.
struct Spread {
  std::vector<SpreadPart> parts;
  std::vector<Bin> bins;
};
// Precondition: both have the same size.
[[nodiscard]] Spread spread_of(const std::vector<double>& x, const std::vector<double>& y);

struct FigurePanel {
  std::string title;  // quantity, symbol and unit
  std::vector<FigureCurve> curves;
  Spread spread = {};  // in the place of curves; the distribution stands beside it
};

// Panels from top to bottom: measured position and model in the last seconds, the force, and the
// residuals of the whole record in counts of the encoder. Takes some milliseconds.
[[nodiscard]] std::vector<FigurePanel> identification_panels(const identify::Record& record,
                                                             const identify::Identification& found);
// The curve with at most 2 * `columns` points: the smallest and the largest value of each part.
// Precondition: columns > 0.
[[nodiscard]] FigureCurve thinned(FigureCurve curve, std::size_t columns);
// Draws the panels one below the other, in the current window.
void draw_panels(const Theme& theme, std::span<const FigurePanel> panels, ImVec2 size);

// These panels as a page. Fails like draw_page().
[[nodiscard]] Result<file::Picture> draw_identification(const identify::Record& record,
                                                        const identify::Identification& found,
                                                        const Paper& paper = {});

}  // namespace hapticwall::draw
