// The marks of recordings in the plots: thin lines across, with their texts.
#pragma once

#include <span>

#include "app/file/mark.h"
#include "app/ui/theme.h"

namespace hapticwall::ui {

// What somebody noted at ticks of this rate, in order.
struct PlotMarks {
  std::span<const file::Mark> list;
  double rate_hz = 1000.0;
};

// Those within the current plot; a text where there is room for it.
void draw_plot_marks(const Theme& theme, const PlotMarks& marks, float line_weight);

}  // namespace hapticwall::ui
