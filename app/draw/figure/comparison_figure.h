// The figure of a comparison: small multiples, a column an algorithm and at most four in a row,
// with the same axes for all.
#pragma once

#include <cstddef>
#include <span>

#include "app/draw/figure/figure.h"
#include "app/draw/plot/sample_history.h"
#include "app/file/picture.h"
#include "core/result.h"
#include "core/scene.h"
#include "core/summary.h"

namespace hapticwall::draw {

// One algorithm of a comparison; axis x of a scene with two axes.
struct ComparedRun {
  Summary summary;
  SampleHistory history;
};

// A page for more runs would be too high.
inline constexpr std::size_t kMaxComparedRuns = 16;
// Columns side by side.
[[nodiscard]] std::size_t compared_columns(const Paper& paper, std::size_t runs);

// The knee of a symlog axis (ticks.h) that shows the smallest of these amplitudes beside the
// largest, in their unit; 0 if a linear axis shows all.
[[nodiscard]] double comparison_knee(std::span<const double> amplitudes);

// Draws a column a run, in the order of `runs`. All runs share `scene`; its algorithm is ignored
// except for the follower. A diverged run does not stretch the axes unless all diverged. The axis
// of energy is a symlog one if the runs differ much. Fails like draw_page().
[[nodiscard]] Result<file::Picture> draw_comparison(const Scene& scene,
                                                    std::span<const ComparedRun> runs,
                                                    const Paper& paper = {});

}  // namespace hapticwall::draw
