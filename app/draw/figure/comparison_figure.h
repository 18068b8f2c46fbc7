// The figure of a comparison: small multiples, a column an algorithm, with the same axes along each
// row.
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

// A page for more runs would be too wide.
inline constexpr std::size_t kMaxComparedRuns = 16;

// The size of a page with readable columns for so many runs.
[[nodiscard]] FigureSize comparison_size(std::size_t runs);

// Draws a column a run, in the order of `runs`. All runs share `scene`; its algorithm is ignored
// except for the follower. A diverged run does not stretch the axes unless all diverged. Fails like
// draw_page().
[[nodiscard]] Result<file::Picture> draw_comparison(const Scene& scene,
                                                    std::span<const ComparedRun> runs,
                                                    FigureSize size);

}  // namespace hapticwall::draw
