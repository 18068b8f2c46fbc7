// The work-precision diagram of a scene: error over cost, one line an integrator, drawn without a
// display.
#pragma once

#include "app/draw/figure/figure.h"
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

}  // namespace hapticwall::draw
