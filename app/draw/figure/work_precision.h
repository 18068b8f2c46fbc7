// The work-precision diagram of a scene: error over cost, one line an integrator, drawn without a
// display.
#pragma once

#include <imgui.h>

#include "app/draw/figure/figure.h"
#include "app/draw/plot/theme.h"
#include "app/file/picture.h"
#include "core/result.h"
#include "core/scene.h"
#include "core/study/accuracy.h"

namespace hapticwall::draw {

inline constexpr FigureSize kWorkPrecisionSize{1600, 800};

// Two plots with logarithmic axes over ns per tick: the largest error of position, and the error of
// the tail's amplitude. Points carry their substeps; a hollow one has another verdict than the
// reference. Runs that diverged are named below. Fails like draw_page().
[[nodiscard]] Result<file::Picture> draw_work_precision(const Scene& scene,
                                                        const AccuracyStudy& study,
                                                        FigureSize size = kWorkPrecisionSize);

// Legend and plots of the same into a window. `scale`: of lines and marks.
void draw_work_precision(const Theme& theme, const AccuracyStudy& study, ImVec2 size, float scale);

}  // namespace hapticwall::draw
