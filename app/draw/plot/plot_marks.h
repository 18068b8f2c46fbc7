// The marks of recordings in the plots: thin lines across, with their texts.
#pragma once

#include <span>

#include "app/draw/plot/theme.h"
#include "app/file/recording/recording_writer.h"

namespace hapticwall::draw {

// The marks in order; their ticks have this rate.
struct PlotMarks {
  std::span<const file::Mark> list;
  double rate_hz = 1000.0;
};

// Draws those within the current plot, with their texts if there is room.
void draw_plot_marks(const Theme& theme, const PlotMarks& marks, float line_weight);

}  // namespace hapticwall::draw
