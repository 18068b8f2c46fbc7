// The result of an identification as a picture.
#pragma once

#include <imgui.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "app/draw/figure/figure.h"
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
struct FigurePanel {
  std::string title;
  std::vector<FigureCurve> curves;
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

inline constexpr FigureSize kIdentificationSize{1600, 1200};

// These panels as a page. Fails like draw_page().
[[nodiscard]] Result<file::Picture> draw_identification(const identify::Record& record,
                                                        const identify::Identification& found,
                                                        FigureSize size = kIdentificationSize);

}  // namespace hapticwall::draw
