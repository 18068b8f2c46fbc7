// A figure with logarithmic axes as a page, drawn without a display.
#pragma once

#include "app/draw/figure/paper.h"
#include "app/draw/plot/log_plot.h"
#include "app/file/picture.h"
#include "core/result.h"

namespace hapticwall::draw {

// Its plots stand side by side, or below each other on narrow paper. Precondition: the figure has a
// plot, and its plots have series. Fails like draw_page().
[[nodiscard]] Result<file::Picture> draw_log_page(const LogFigure& figure, const Paper& paper = {});

}  // namespace hapticwall::draw
